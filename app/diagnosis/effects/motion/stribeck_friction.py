"""Dry friction that is larger near standstill and fades with speed (Stribeck 1902)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class StribeckFriction(JointLaw):
    key = "stribeck_friction"
    title = "dry friction that is larger near standstill"
    driver = "speed"
    equation = "tau = stribeck * exp(-(qd / stribeck_speed)^2) * sign(qd)"
    units: ClassVar = {"stribeck": "Nm", "stribeck_speed": "rad/s"}
    linear = ("stribeck",)
    shape_bounds: ClassVar = {"stribeck_speed": (1e-3, 10.0)}
    positive = ("stribeck",)
    resists = True

    def shapes(self, state: State, joint: int) -> list[Values]:
        return [{"stribeck_speed": share * float(state.speed[joint])} for share in (0.06, 0.12, 0.25, 0.45)]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        qd = state.qd[:, joint_of(where), None]
        return np.exp(-((qd / shape["stribeck_speed"]) ** 2)) * np.sign(qd)


EFFECT = StribeckFriction()
