"""Dry friction that grows with the torque the gear carries."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values, direction
from app.diagnosis.models.dynamic.state import State


class LoadFriction(JointLaw):
    key = "load_friction"
    title = "dry friction that grows with the load on the gear"
    family = "friction"
    driver = "gravity_torque"
    equation = "tau = load * |tau_rigid| * sign(qd)"
    units: ClassVar = {"load": ""}
    blunt = True
    follows_load = True
    linear = ("load",)
    positive = ("load",)
    drifts = True

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return (np.abs(state.torque[:, joint]) * direction(state, joint, fixed))[:, None]


EFFECT = LoadFriction()
