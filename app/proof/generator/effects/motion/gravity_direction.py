"""The base leans: gravity points elsewhere in it than the description says."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.dynamics import GRAVITY, turned_gravity
from app.proof.generator.effects.term import Size, Term

LEAN = (0.015, 0.06)  # rad


@dataclass(frozen=True)
class GravityDirection:
    key: str = "gravity_direction"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("gx", "m/s^2"), Size("gy", "m/s^2"), Size("gz", "m/s^2"))

    def draw(self, rng, cell, asked):
        way = rng.uniform(0, 2 * np.pi)
        g = turned_gravity(rng.uniform(*LEAN) * np.array([np.cos(way), np.sin(way), 0.0]))
        values = {name: float(x) for name, x in zip(("gx", "gy", "gz"), g, strict=True)}
        return Term(self.key, {"body": "base", "driver": "gravity_torque"}, values, scalable=False)

    def add(self, cell, term, world):
        world.gravity = world.gravity + _vector(term) - GRAVITY


def _vector(term: Term) -> np.ndarray:
    return np.array([term.parameters[k] for k in ("gx", "gy", "gz")])


EFFECT = GravityDirection()
