"""Friction that grows with speed."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values
from app.diagnosis.models.dynamic.state import State


class ViscousFriction(JointLaw):
    key = "viscous_friction"
    title = "friction proportional to speed"
    family = "friction"
    driver = "speed"
    equation = "tau = viscous * qd"
    units: ClassVar = {"viscous": "Nm s/rad"}
    linear = ("viscous",)
    in_joint: ClassVar = {"viscous": "damping"}
    servo_alike = ("delay",)  # a command followed late by d leaves stiffness times d times the speed
    positive = ("viscous",)
    drifts = True
    whole = True

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return state.qd[:, joint, None]


EFFECT = ViscousFriction()
