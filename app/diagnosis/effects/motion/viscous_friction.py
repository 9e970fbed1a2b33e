"""Friction that grows with speed."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class ViscousFriction(JointLaw):
    key = "viscous_friction"
    title = "friction proportional to speed"
    driver = "speed"
    equation = "tau = viscous * qd"
    units: ClassVar = {"viscous": "Nm s/rad"}
    linear = ("viscous",)
    positive = ("viscous",)
    resists = True
    common = True

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return state.qd[:, joint_of(where), None]


EFFECT = ViscousFriction()
