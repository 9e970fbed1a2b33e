"""The controller was asked too early: each joint is beyond what is shown by a share of its last move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class EarlyReading:
    key: str = "early_reading"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("share", "1"),)

    def draw(self, rng, cell, asked):
        return Term(self.key, {"body": "instrument", "driver": "approach"}, {"share": 1e-3})

    def add(self, cell, term, world):
        step = np.diff(cell.q, axis=0, prepend=cell.q[:1])
        step[np.diff(cell.session, prepend=cell.session[:1]) != 0] = 0.0
        world.dq += term.parameters["share"] * step


EFFECT = EarlyReading()
