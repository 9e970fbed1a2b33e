"""Friction in proportion to speed: tau += viscous * qd."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._joint import JointTorque
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class ViscousFriction(JointTorque):
    key: str = "viscous_friction"
    driver: str = "speed"
    sizes: tuple[Size, ...] = (Size("viscous", "Nm s/rad"),)

    def torque(self, cell, j, values):
        return values["viscous"] * cell.qd[:, j]


EFFECT = ViscousFriction()
