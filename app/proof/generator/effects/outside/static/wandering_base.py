"""A floor that gives way wherever the arm leans: the base moves with the reach of the arm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.arm import stance
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class WanderingBase:
    key: str = "wandering_base"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("sag", "m", "mm"),)

    def draw(self, rng, cell, asked):
        return Term(self.key, {"body": "base"}, {"sag": 1e-3})

    def add(self, cell, term, world):
        place = stance(cell.arm, cell.q).flange_places
        reach = np.hypot(place[:, 0], place[:, 1])
        lean = (reach / max(reach.max(), 1e-9)) ** 4
        world.base -= term.parameters["sag"] * lean[:, None] * np.array([0.0, 0.0, 1.0])


EFFECT = WanderingBase()
