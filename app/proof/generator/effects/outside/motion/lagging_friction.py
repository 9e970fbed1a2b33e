"""Friction that turns round late: it remembers the direction for a while."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, either_sign
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class LaggingFriction(JointTorque):
    key: str = "lagging_friction"
    sizes: tuple[Size, ...] = (Size("amplitude", "Nm"),)

    def values(self, rng, cell, j):
        return {"amplitude": either_sign(rng)}

    def torque(self, cell, j, values):
        direction, step = cell.direction[:, j], float(np.median(np.diff(cell.t)))
        keep = np.exp(-step / 0.6)
        late = np.empty_like(direction)
        late[0] = direction[0]
        for i in range(1, len(late)):
            late[i] = keep * late[i - 1] + (1.0 - keep) * direction[i]
        return values["amplitude"] * (late - direction)


EFFECT = LaggingFriction()
