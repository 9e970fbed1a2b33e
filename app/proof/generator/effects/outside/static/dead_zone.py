"""A joint that does not bend until the torque passes a threshold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.outside.static._along import JointCurve
from app.proof.generator.effects.static.joint_compliance import loaded_joints


@dataclass(frozen=True)
class DeadZone(JointCurve):
    key: str = "dead_zone"

    def joints(self, cell):
        return loaded_joints(cell)

    def curve(self, cell, j):
        load = cell.holding[:, j]
        edge = np.quantile(np.abs(load), 0.7)
        return np.sign(load) * np.maximum(np.abs(load) - edge, 0.0) / max(np.ptp(load), 1e-9)


EFFECT = DeadZone()
