"""A torque that gives way when the drive works hardest: it follows the product of torque and speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class PowerLimit(JointTorque):
    key: str = "power_limit"
    sizes: tuple[Size, ...] = (Size("amplitude", "Nm"),)

    def values(self, rng, cell, j):
        return {"amplitude": either_sign(rng)}

    def torque(self, cell, j, values):
        power = cell.rigid[:, j] * cell.qd[:, j]
        top = max(float(np.abs(power).max()), 1e-9)
        return values["amplitude"] * np.maximum(power / top - 0.15, 0.0)


EFFECT = PowerLimit()
