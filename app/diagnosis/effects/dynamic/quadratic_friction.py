"""Friction that grows with the square of speed."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values
from app.diagnosis.models.dynamic.state import State


class QuadraticFriction(JointLaw):
    key = "quadratic_friction"
    title = "friction that grows with the square of speed"
    family = "friction"
    driver = "speed"
    equation = "tau = quadratic * qd * |qd|"
    units: ClassVar = {"quadratic": "Nm s^2/rad^2"}
    linear = ("quadratic",)
    in_joint: ClassVar = {"quadratic": "damping2"}
    positive = ("quadratic",)
    drifts = True

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return (state.qd[:, joint] * np.abs(state.qd[:, joint]))[:, None]


EFFECT = QuadraticFriction()
