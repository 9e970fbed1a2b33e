"""A joint's gear gives way under the load it holds: q_true = q - compliance * holding torque."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick

WORTH = 0.02  # of the largest torque in the arm: below, a joint is not loaded by gravity


@dataclass(frozen=True)
class JointCompliance:
    key: str = "joint_compliance"
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = (Size("compliance", "rad/Nm"),)

    def draw(self, rng, cell, asked):
        choices = list(range(1, cell.arm.n + 1)) if "joint" in asked else loaded_joints(cell)
        joint = pick(rng, asked, "joint", choices, self.key)
        return Term(self.key, {"joint": joint, "driver": "gravity_torque"}, {"compliance": 1e-5})

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        load = cell.holding[:, j] + world.torque[:, j]
        world.dq[:, j] -= term.parameters["compliance"] * load


def loaded_joints(cell) -> list[int]:
    """Joints (from 1) whose holding torque changes over the recording."""
    spread = np.std(cell.holding, axis=0)
    return [j + 1 for j in range(cell.arm.n) if spread[j] > WORTH * max(spread.max(), 1e-9)]


EFFECT = JointCompliance()
