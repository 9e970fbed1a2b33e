"""A spring on a joint (a balancer, a hose package): torque proportional to its angle."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class JointSpring(JointLaw):
    key = "joint_spring"
    title = "a spring on the joint"
    driver = "own_angle"
    equation = "tau = stiffness * q + offset"
    units: ClassVar = {"stiffness": "Nm/rad", "offset": "Nm"}
    linear = ("stiffness", "offset")
    within = "friction_asymmetry"

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        q = state.q[:, joint_of(where)]
        return np.stack([q, np.ones_like(q)], axis=1)


EFFECT = JointSpring()
