"""Dry friction that grows with the torque the gear carries."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class LoadFriction(JointLaw):
    key = "load_friction"
    title = "dry friction that grows with the load on the gear"
    driver = "gravity_torque"
    equation = "tau = load * |tau_rigid| * sign(qd)"
    units: ClassVar = {"load": ""}
    linear = ("load",)
    positive = ("load",)

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        j = joint_of(where)
        return (np.abs(state.torque[:, j]) * np.sign(state.qd[:, j]))[:, None]


EFFECT = LoadFriction()
