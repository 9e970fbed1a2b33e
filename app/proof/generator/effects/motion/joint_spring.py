"""A spring on a joint: tau += stiffness * q + offset."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._joint import JointTorque, strengthened
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class JointSpring(JointTorque):
    key: str = "joint_spring"
    driver: str = "own_angle"
    sizes: tuple[Size, ...] = (
        Size("stiffness", "Nm/rad"),
        Size("offset", "Nm"),
    )

    def values(self, rng, cell, j):
        rest = float(rng.uniform(cell.q[:, j].min(), cell.q[:, j].max()))
        return {"stiffness": 1.0, "offset": -rest}

    def torque(self, cell, j, values):
        return values["stiffness"] * cell.q[:, j] + values["offset"]

    def stronger(self, term, factor):
        return strengthened(term, factor, ("stiffness", "offset"))


EFFECT = JointSpring()
