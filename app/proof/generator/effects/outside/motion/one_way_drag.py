"""Drag that acts in one direction only, with the square root of speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class OneWayDrag(JointTorque):
    key: str = "one_way_drag"
    sizes: tuple[Size, ...] = (Size("amplitude", "Nm"),)

    def values(self, rng, cell, j):
        return {"amplitude": either_sign(rng)}

    def torque(self, cell, j, values):
        speed = np.maximum(cell.qd[:, j], 0.0)
        top = max(float(np.abs(cell.qd[:, j]).max()), 1e-6)
        return values["amplitude"] * np.sqrt(speed / top)


EFFECT = OneWayDrag()
