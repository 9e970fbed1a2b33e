"""Friction that falls as the gear warms up: tau += cold * exp(-t / time_constant) * sign(qd)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class WarmupFriction(JointTorque):
    key: str = "warmup_friction"
    driver: str = "time"
    sizes: tuple[Size, ...] = (
        Size("cold", "Nm"),
        Size("time_constant", "s"),
    )

    def values(self, rng, cell, j):
        return {"cold": 1.0, "time_constant": float(rng.uniform(0.15, 0.6)) * float(np.ptp(cell.t))}

    def torque(self, cell, j, values):
        return values["cold"] * np.exp(-cell.t / values["time_constant"]) * cell.direction[:, j]


EFFECT = WarmupFriction()
