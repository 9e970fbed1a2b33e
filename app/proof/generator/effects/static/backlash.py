"""Play in a gear: the link rests on one flank, by the last move or by its weight.

A controller that makes up for more play than there is leaves a gap below nothing: the link leads.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.static.joint_compliance import loaded_joints
from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class Backlash:
    key: str = "backlash"
    places: tuple[str, ...] = ("joint", "driver")
    sizes: tuple[Size, ...] = (Size("gap", "rad", "deg"),)

    def draw(self, rng, cell, asked):
        driver = pick(rng, asked, "driver", ["approach", "gravity_torque"], self.key)
        joints = list(range(1, cell.arm.n + 1)) if driver == "approach" else loaded_joints(cell)
        joint = pick(rng, asked, "joint", joints, self.key)
        gap = -1e-3 if asked.get("leads") else 1e-3
        return Term(self.key, {"joint": joint, "driver": driver}, {"gap": gap})

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        moved = term.where["driver"] == "approach"
        side = cell.last_move[:, j] if moved else np.sign(cell.holding[:, j])
        world.dq[:, j] -= 0.5 * term.parameters["gap"] * side


EFFECT = Backlash()
