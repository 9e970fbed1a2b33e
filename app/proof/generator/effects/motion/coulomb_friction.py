"""Dry friction: tau += coulomb * sign(qd)."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._joint import JointTorque
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class CoulombFriction(JointTorque):
    key: str = "coulomb_friction"
    driver: str = "speed"
    sizes: tuple[Size, ...] = (Size("coulomb", "Nm"),)

    def torque(self, cell, j, values):
        return values["coulomb"] * cell.direction[:, j]


EFFECT = CoulombFriction()
