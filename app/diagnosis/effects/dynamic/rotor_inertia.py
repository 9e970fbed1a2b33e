"""The rotor's inertia, seen through the gear: torque proportional to the joint's own acceleration."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values
from app.diagnosis.models.dynamic.state import State


class RotorInertia(JointLaw):
    key = "rotor_inertia"
    title = "inertia of the rotor"
    family = "rotors"
    driver = "acceleration"
    equation = "tau = inertia * qdd"
    units: ClassVar = {"inertia": "kg m^2"}
    linear = ("inertia",)
    in_joint: ClassVar = {"inertia": "armature"}
    positive = ("inertia",)
    whole = True

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return state.qdd[:, joint, None]


EFFECT = RotorInertia()
