"""A worn stretch of teeth: a bump of torque at one place of the joint's range."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class WornTeeth(JointTorque):
    key: str = "worn_teeth"
    sizes: tuple[Size, ...] = (Size("amplitude", "Nm"),)

    def values(self, rng, cell, j):
        return {"amplitude": either_sign(rng)}

    def torque(self, cell, j, values):
        q = cell.q[:, j]
        middle, wide = float(np.median(q)), 0.08 * float(np.ptp(q))
        return values["amplitude"] * np.exp(-(((q - middle) / max(wide, 1e-6)) ** 2))


EFFECT = WornTeeth()
