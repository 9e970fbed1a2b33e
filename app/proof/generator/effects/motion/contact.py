"""The tool pushes on something for a while: tau += J^T (force, lever x force) between from_s and to_s."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._window import end_time, start_time, within
from app.proof.generator.effects.term import Size, Term
from app.proof.generator.motion.cell import wrench_torques
from app.proof.generator.rotations import random_direction

FORCE = ("force_x", "force_y", "force_z")
MOMENT = ("moment_x", "moment_y", "moment_z")
_FARTHEST = 0.2  # m from the flange to where it is touched: tools, and hands


@dataclass(frozen=True)
class Contact:
    key: str = "contact"
    places: tuple[str, ...] = ("from_s", "to_s")
    sizes: tuple[Size, ...] = (*(Size(name, "N") for name in FORCE), *(Size(name, "Nm") for name in MOMENT))

    def draw(self, rng, cell, asked):
        start = start_time(rng, cell, asked, self.key)
        where = {"body": "tool", "driver": "time", "from_s": start}
        where["to_s"] = end_time(rng, cell, asked, start, self.key)
        force = rng.uniform(10.0, 50.0) * random_direction(rng)
        moment = np.cross(rng.uniform(0.0, _FARTHEST) * random_direction(rng), force)
        drawn = zip((*FORCE, *MOMENT), (*force, *moment), strict=True)
        return Term(self.key, where, {name: float(value) for name, value in drawn}, scalable=False)

    def add(self, cell, term, world):
        force, moment = (np.array([term.parameters[name] for name in names]) for names in (FORCE, MOMENT))
        world.torque += within(cell, term.where)[:, None] * wrench_torques(cell, force, moment)


EFFECT = Contact()
