"""Friction that grows with the square of speed: tau += quadratic * qd |qd|."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class QuadraticFriction(JointTorque):
    key: str = "quadratic_friction"
    driver: str = "speed"
    sizes: tuple[Size, ...] = (Size("quadratic", "Nm s^2/rad^2"),)

    def torque(self, cell, j, values):
        return values["quadratic"] * cell.qd[:, j] * np.abs(cell.qd[:, j])


EFFECT = QuadraticFriction()
