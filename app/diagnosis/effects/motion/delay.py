"""Torque and position do not belong to the same instant: the torque is recorded late (or early)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import Law, Place, Values, Where
from app.diagnosis.effects.motion._state import State


class Delay(Law):
    key = "delay"
    title = "the torque is recorded late"
    driver = "time"
    equation = "tau_recorded(t) = tau(t - delay)"
    units: ClassVar = {"delay": "s"}
    linear = ("delay",)
    shared = True
    follows_model = True
    corrected = True

    def places(self, state: State) -> list[Place]:
        return [Place({"driver": "time"})]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return -state.torque_rate[:, :, None]

    def apply(
        self, state: State, where: Where, values: Values, torque: np.ndarray | None = None
    ) -> np.ndarray:
        base = state.torque if torque is None else torque
        if "joint" in where:  # late against its command: the torques belong to the measured motion
            return np.zeros_like(base)
        late = state.t - values["delay"]
        return np.stack([np.interp(late, state.t, column) for column in base.T], axis=1) - base

    def explain(self, where: Where, values: Values) -> str:
        late = "late" if values["delay"] > 0 else "early"
        return f"Torques are recorded {abs(values['delay']):.4g} s {late} against the positions."


EFFECT = Delay()
