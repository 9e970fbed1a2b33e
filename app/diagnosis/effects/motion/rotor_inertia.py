"""The rotor's inertia, seen through the gear: torque proportional to the joint's own acceleration."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class RotorInertia(JointLaw):
    key = "rotor_inertia"
    title = "inertia of the rotor"
    driver = "acceleration"
    equation = "tau = inertia * qdd"
    units: ClassVar = {"inertia": "kg m^2"}
    linear = ("inertia",)
    positive = ("inertia",)

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return state.qdd[:, joint_of(where), None]


EFFECT = RotorInertia()
