"""A joint that bends with the cube of the torque it holds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.outside.static._along import JointCurve
from app.proof.generator.effects.static.joint_compliance import loaded_joints


@dataclass(frozen=True)
class CubicBending(JointCurve):
    key: str = "cubic_bending"

    def joints(self, cell):
        return loaded_joints(cell)

    def curve(self, cell, j):
        load = cell.holding[:, j] / np.abs(cell.holding[:, j]).max()
        return load**3


EFFECT = CubicBending()
