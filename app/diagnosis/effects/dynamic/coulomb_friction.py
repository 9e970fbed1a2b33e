"""Dry friction: as large at any speed, against the motion."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values, direction
from app.diagnosis.models.dynamic.state import State


class CoulombFriction(JointLaw):
    key = "coulomb_friction"
    title = "dry friction"
    family = "friction"
    driver = "speed"
    equation = "tau = coulomb * sign(qd)"
    units: ClassVar = {"coulomb": "Nm"}
    blunt = True
    linear = ("coulomb",)
    in_joint: ClassVar = {"coulomb": "friction"}
    positive = ("coulomb",)
    drifts = True
    whole = True

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return direction(state, joint, fixed)[:, None]


EFFECT = CoulombFriction()
