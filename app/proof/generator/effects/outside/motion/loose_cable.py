"""A cable that pulls where two joints stand together in one corner of their ranges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class LooseCable(JointTorque):
    key: str = "loose_cable"
    sizes: tuple[Size, ...] = (Size("amplitude", "Nm"),)

    def values(self, rng, cell, j):
        return {"amplitude": either_sign(rng)}

    def torque(self, cell, j, values):
        other = j + 1 if j + 1 < cell.arm.n else j - 1
        a, b = cell.q[:, j] - np.median(cell.q[:, j]), cell.q[:, other] - np.median(cell.q[:, other])
        both = np.maximum(a, 0.0) * np.maximum(b, 0.0)
        return values["amplitude"] * both / max(float(both.max()), 1e-9)


EFFECT = LooseCable()
