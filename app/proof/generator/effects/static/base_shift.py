"""The base was knocked: from one row on the arm stands elsewhere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.static._step import after, step_row
from app.proof.generator.effects.term import Size, Term
from app.proof.generator.rotations import random_direction
from app.units import from_mm


@dataclass(frozen=True)
class BaseShift:
    key: str = "base_shift"
    places: tuple[str, ...] = ("from_row",)
    sizes: tuple[Size, ...] = (Size("dx", "m", "mm"), Size("dy", "m", "mm"), Size("dz", "m", "mm"))

    def draw(self, rng, cell, asked):
        row = step_row(rng, cell, asked, self.key)
        step = from_mm(random_direction(rng))
        values = {name: float(x) for name, x in zip(("dx", "dy", "dz"), step, strict=True)}
        return Term(self.key, {"body": "base", "from_row": row}, values)

    def add(self, cell, term, world):
        step = np.array([term.parameters[k] for k in ("dx", "dy", "dz")])
        turn = np.array([term.parameters.get(k, 0.0) for k in ("rx", "ry", "rz")])
        since = after(cell, term.where["from_row"])[:, None]
        world.base += since * step
        world.base_turn += since * turn


EFFECT = BaseShift()
