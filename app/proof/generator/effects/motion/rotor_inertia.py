"""The rotor behind the gear: tau += inertia * qdd."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._joint import JointTorque
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class RotorInertia(JointTorque):
    key: str = "rotor_inertia"
    driver: str = "acceleration"
    sizes: tuple[Size, ...] = (Size("inertia", "kg m^2"),)

    def torque(self, cell, j, values):
        return values["inertia"] * cell.qdd[:, j]


EFFECT = RotorInertia()
