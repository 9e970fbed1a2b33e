"""A wheel that runs out of centre: q_true = q + s sin(q) + c cos(q)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick

_START_RAD = 0.001  # any size: the draw is scaled to the wanted displacement afterwards


@dataclass(frozen=True)
class GearEccentricity:
    key: str = "gear_eccentricity"
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = (Size("sin", "rad", "deg"), Size("cos", "rad", "deg"))

    def draw(self, rng, cell, asked):
        turning = [j + 1 for j in range(cell.arm.n) if not cell.arm.slides[j]]
        joint = pick(rng, asked, "joint", turning, self.key)
        phase = rng.uniform(0, 2 * np.pi)
        values = {"sin": _START_RAD * float(np.cos(phase)), "cos": _START_RAD * float(np.sin(phase))}
        return Term(self.key, {"joint": joint, "driver": "own_angle"}, values)

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        q, v = cell.q[:, j], term.parameters
        world.dq[:, j] += v["sin"] * np.sin(q) + v["cos"] * np.cos(q)


EFFECT = GearEccentricity()
