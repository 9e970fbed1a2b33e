"""Friction that grows with the square of speed."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class QuadraticFriction(JointLaw):
    key = "quadratic_friction"
    title = "friction that grows with the square of speed"
    driver = "speed"
    equation = "tau = quadratic * qd * |qd|"
    units: ClassVar = {"quadratic": "Nm s^2/rad^2"}
    linear = ("quadratic",)
    positive = ("quadratic",)
    resists = True

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        qd = state.qd[:, joint_of(where), None]
        return qd * np.abs(qd)


EFFECT = QuadraticFriction()
