"""Dry friction: as large at any speed, against the motion."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class CoulombFriction(JointLaw):
    key = "coulomb_friction"
    title = "dry friction"
    driver = "speed"
    equation = "tau = coulomb * sign(qd)"
    units: ClassVar = {"coulomb": "Nm"}
    linear = ("coulomb",)
    positive = ("coulomb",)
    resists = True
    common = True

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return np.sign(state.qd[:, joint_of(where), None])


EFFECT = CoulombFriction()
