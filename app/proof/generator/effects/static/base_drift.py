"""The base wanders with time: p_base moves by (vx, vy, vz) * time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term
from app.proof.generator.rotations import random_direction


@dataclass(frozen=True)
class BaseDrift:
    key: str = "base_drift"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("vx", "m/s", "mm"), Size("vy", "m/s", "mm"), Size("vz", "m/s", "mm"))

    def draw(self, rng, cell, asked):
        v = 1e-6 * random_direction(rng)
        values = {name: float(x) for name, x in zip(("vx", "vy", "vz"), v, strict=True)}
        return Term(self.key, {"body": "base", "driver": "time"}, values)

    def add(self, cell, term, world):
        v = np.array([term.parameters[k] for k in ("vx", "vy", "vz")])
        w = np.array([term.parameters.get(k, 0.0) for k in ("wx", "wy", "wz")])
        passed = (cell.t - cell.t[0])[:, None]
        world.base += passed * v
        world.base_turn += passed * w


EFFECT = BaseDrift()
