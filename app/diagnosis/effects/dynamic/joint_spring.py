"""A spring on a joint (a balancer, a hose package): torque proportional to its angle, or to its sine."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values
from app.diagnosis.models.dynamic.state import State


class JointSpring(JointLaw):
    key = "joint_spring"
    title = "a spring on the joint"
    family = "load"
    driver = "own_angle"
    equation = "tau = stiffness * q + offset"
    units: ClassVar = {"stiffness": "Nm/rad", "offset": "Nm"}
    linear = ("stiffness", "offset")
    in_joint: ClassVar = {"stiffness": "stiffness", "offset": "offset"}
    carried = True
    contains = "friction_asymmetry"

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return np.stack([state.q[:, joint], np.ones(len(state.t))], axis=1)


EFFECT = JointSpring()
