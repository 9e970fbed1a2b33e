"""Dry friction that is larger near standstill: tau += stribeck * exp(-(qd / stribeck_speed)^2) * sign(qd)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class StribeckFriction(JointTorque):
    key: str = "stribeck_friction"
    driver: str = "speed"
    sizes: tuple[Size, ...] = (
        Size("stribeck", "Nm"),
        Size("stribeck_speed", "rad/s"),
    )

    def values(self, rng, cell, j):
        usual = float(np.quantile(np.abs(cell.qd[:, j]), 0.9))
        return {"stribeck": 1.0, "stribeck_speed": float(rng.uniform(0.1, 0.4)) * usual}

    def torque(self, cell, j, values):
        fade = np.exp(-((cell.qd[:, j] / values["stribeck_speed"]) ** 2))
        return values["stribeck"] * fade * cell.direction[:, j]


EFFECT = StribeckFriction()
