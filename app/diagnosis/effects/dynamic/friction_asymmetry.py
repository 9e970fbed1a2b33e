"""Dry friction of another size in either direction: on one joint the same as a constant torque."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State


class FrictionAsymmetry(JointLaw):
    key = "friction_asymmetry"
    title = "dry friction of another size in either direction, or a constant torque offset"
    family = "friction"
    driver = "speed"
    equation = "tau = offset (half the difference of the two levels)"
    units: ClassVar = {"offset": "Nm"}
    linear = ("offset",)
    in_joint: ClassVar = {"offset": "offset"}
    whole = True
    apart = True

    def places(self, situation: State) -> Iterable[Place]:
        return [Place({"joint": j + 1, "driver": self.driver}) for j in range(situation.joints)]

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return np.ones((len(state.t), 1))


EFFECT = FrictionAsymmetry()
