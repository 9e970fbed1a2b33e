"""A torque that swings with time alone, as a pump or a floor does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class Beating(JointTorque):
    key: str = "beating"
    sizes: tuple[Size, ...] = (Size("amplitude", "Nm"),)

    def values(self, rng, cell, j):
        return {"amplitude": either_sign(rng)}

    def torque(self, cell, j, values):
        return values["amplitude"] * np.sin(2.0 * np.pi * 0.37 * cell.t + 0.6)


EFFECT = Beating()
