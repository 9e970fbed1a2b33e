"""A link warms up and grows: its length is (1 + rate * time) of the described one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick

SHORTEST = 0.05  # m; below, growth moves nothing


@dataclass(frozen=True)
class ThermalGrowth:
    key: str = "thermal_growth"
    places: tuple[str, ...] = ("link",)
    sizes: tuple[Size, ...] = (Size("rate", "1/s"),)

    def draw(self, rng, cell, asked):
        lengths = np.linalg.norm(cell.described.translations[1:], axis=1)
        links = [k + 1 for k in range(cell.arm.n) if lengths[k] > SHORTEST]
        link = pick(rng, asked, "link", links, self.key)
        return Term(self.key, {"link": link, "driver": "time"}, {"rate": 1e-6})

    def add(self, cell, term, world):
        link = term.where["link"]
        growth = term.parameters["rate"] * (cell.t - cell.t[0])
        world.shifts[:, link] += growth[:, None] * cell.described.translations[link]


EFFECT = ThermalGrowth()
