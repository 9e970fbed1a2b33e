"""The flange pushes on something for a while: tau += J^T force between from_s and to_s."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._window import end_time, start_time, within
from app.proof.generator.effects.term import Size, Term
from app.proof.generator.motion.cell import flange_force_torques
from app.proof.generator.rotations import random_direction

NAMES = ("force_x", "force_y", "force_z")


@dataclass(frozen=True)
class Contact:
    key: str = "contact"
    places: tuple[str, ...] = ("from_s", "to_s")
    sizes: tuple[Size, ...] = tuple(Size(name, "N") for name in NAMES)

    def draw(self, rng, cell, asked):
        start = start_time(rng, cell, asked, self.key)
        where = {"body": "tool", "driver": "time", "from_s": start}
        where["to_s"] = end_time(rng, cell, asked, start, self.key)
        force = rng.uniform(10.0, 50.0) * random_direction(rng)
        return Term(
            self.key, where, {name: float(f) for name, f in zip(NAMES, force, strict=True)}, scalable=False
        )

    def add(self, cell, term, world):
        force = np.array([term.parameters[name] for name in NAMES])
        world.torque += within(cell, term.where)[:, None] * (flange_force_torques(cell) @ force)


EFFECT = Contact()
