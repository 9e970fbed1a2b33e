"""Dry friction of another size in either direction: on one joint the same as a constant torque."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Place, Values, Where
from app.diagnosis.effects.motion._state import State


class FrictionAsymmetry(JointLaw):
    key = "friction_asymmetry"
    title = "dry friction of another size in either direction, or a constant torque offset"
    driver = "speed"
    equation = "tau = offset (half the difference of the two levels)"
    units: ClassVar = {"offset": "Nm"}
    linear = ("offset",)

    def places(self, state: State) -> list[Place]:
        return [Place({"joint": j + 1, "driver": self.driver}) for j in range(state.joints)]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return np.ones((len(state.t), 1))


EFFECT = FrictionAsymmetry()
