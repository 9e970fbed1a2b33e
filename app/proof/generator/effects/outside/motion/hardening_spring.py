"""A spring that hardens with the cube of its deflection."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class HardeningSpring(JointTorque):
    key: str = "hardening_spring"
    sizes: tuple[Size, ...] = (Size("amplitude", "Nm"),)

    def values(self, rng, cell, j):
        return {"amplitude": either_sign(rng)}

    def torque(self, cell, j, values):
        q = cell.q[:, j]
        half = 0.5 * float(np.ptp(q))
        bent = (q - 0.5 * float(q.max() + q.min())) / max(half, 1e-6)
        return values["amplitude"] * (bent**3 - 0.6 * bent)


EFFECT = HardeningSpring()
