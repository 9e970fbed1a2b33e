"""Friction that falls while the gear warms up, over time or, where it is recorded, with temperature."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Place, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State


class WarmupFriction(JointLaw):
    key = "warmup_friction"
    title = "friction that falls as the joint warms up"
    driver = "time"
    equation = "tau = cold * exp(-t / time_constant) * sign(qd)"
    units: ClassVar = {"cold": "Nm", "time_constant": "s", "per_degree": "Nm/degC"}
    linear = ("cold",)
    shape_bounds: ClassVar = {"time_constant": (0.2, 1e5)}

    def places(self, state: State) -> list[Place]:
        return [
            Place({"joint": j + 1, "driver": "time"}, {"time_constant": share * state.seconds})
            for j in range(state.joints)
            if state.moves(j)
            for share in (0.08, 0.2, 0.45, 1.0)
        ]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        fall = np.exp(-state.t / shape["time_constant"])
        return (fall * np.sign(state.qd[:, joint_of(where)]))[:, None]

    def lawful(self, values: Values) -> bool:
        return values["cold"] > 0


EFFECT = WarmupFriction()
