"""Dry friction of another level in either direction: tau += offset on top of it, moving either way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class FrictionAsymmetry(JointTorque):
    key: str = "friction_asymmetry"
    driver: str = "speed"
    sizes: tuple[Size, ...] = (Size("offset", "Nm"),)

    def values(self, rng, cell, j):
        return {"offset": either_sign(rng)}

    def torque(self, cell, j, values):
        return np.full(cell.m, values["offset"])


EFFECT = FrictionAsymmetry()
