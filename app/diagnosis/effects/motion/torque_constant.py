"""A joint's torque is recorded too large or too small by a factor: a wrong drive gain or sensor scale."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Place, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class TorqueConstant(JointLaw):
    key = "torque_constant"
    title = "its torque is recorded by a wrong factor"
    driver = ""
    equation = "tau_recorded = (1 + scale) * tau"
    units: ClassVar = {"scale": ""}
    linear = ("scale",)
    follows_model = True
    corrected = True

    def places(self, state: State) -> list[Place]:
        return [Place({"joint": j + 1}) for j in range(state.joints)]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return state.torque[:, joint_of(where), None]

    def apply(
        self, state: State, where: Where, values: Values, torque: np.ndarray | None = None
    ) -> np.ndarray:
        base = state.torque if torque is None else torque
        return values["scale"] * base[:, joint_of(where)]

    def lawful(self, values: Values) -> bool:
        return -0.6 < values["scale"] < 1.5  # beyond, it is no torque of this joint


EFFECT = TorqueConstant()
