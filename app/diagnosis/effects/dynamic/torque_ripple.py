"""Torque that swings with the joint's own angle: cogging, gear meshing, an oval flexspline."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values, choice
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter

ORDERS = range(2, 41)  # per turn; the fit bends them
LEAST_TURN = 2.5  # rad of the wave the joint must sweep, and may at most pass within a window


class TorqueRipple(JointLaw):
    key = "torque_ripple"
    title = "torque that swings with its own angle"
    family = "drive"
    driver = "own_angle"
    equation = "tau = sine * sin(order * q) + cosine * cos(order * q)"
    units: ClassVar = {"sine": "Nm", "cosine": "Nm", "order": "1/turn"}
    linear = ("sine", "cosine")
    series = True
    bent: ClassVar = {"order": 0.02}

    def forms(self, state: State, joint: int) -> list[tuple[Values, float]]:
        if state.sliding[joint]:
            return []
        span, fastest = float(np.ptp(state.q[:, joint])), float(np.abs(state.qd[:, joint]).max())
        seen = [k for k in ORDERS if k * span > LEAST_TURN and fastest * k * state.window < LEAST_TURN]
        return [({"order": float(k)}, choice(len(seen))) for k in seen]

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        return state.wave(joint, fixed["order"])

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        values = {p.name: p.value for p in parameters}
        size = float(np.hypot(values["sine"], values["cosine"]))
        return f"Joint {place.where['joint']}: torque swings by {size:.4g} Nm, {values['order']:.4g} times a turn."


EFFECT = TorqueRipple()
