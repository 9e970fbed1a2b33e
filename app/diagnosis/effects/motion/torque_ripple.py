"""Torque that swings with the joint's own angle: cogging, gear meshing, an oval flexspline."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Place, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State

ORDERS = (*range(2, 25), *range(26, 62, 2))  # per turn; the fit bends them


class TorqueRipple(JointLaw):
    key = "torque_ripple"
    title = "torque that swings with its own angle"
    driver = "own_angle"
    equation = "tau = sine * sin(order * q) + cosine * cos(order * q)"
    units: ClassVar = {"sine": "Nm", "cosine": "Nm", "order": "1/turn"}
    linear = ("sine", "cosine")
    shape_bounds: ClassVar = {"order": (0.7, 1000.0)}

    def places(self, state: State) -> list[Place]:
        out = []
        for j in range(state.joints):
            if not state.moves(j) or state.sliding[j]:
                continue
            span = float(np.ptp(state.q[:, j]))
            whole = [
                order for order in ORDERS if order * span > 2 * np.pi
            ]  # one whole swing or it is no swing
            where = {"joint": j + 1, "driver": self.driver}
            out += [Place(where, {"order": float(order)}) for order in whole]
        return out

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        joint, order = joint_of(where), shape["order"]
        if order in ORDERS:  # whole powers of one turn: a few products instead of a sine
            turned = state.turned(joint, int(order))
            return np.stack([np.imag(turned), np.real(turned)], axis=1)
        angle = order * state.q[:, joint]
        return np.stack([np.sin(angle), np.cos(angle)], axis=1)

    def explain(self, where: Where, values: Values) -> str:
        size = float(np.hypot(values["sine"], values["cosine"]))
        return f"Joint {where['joint']}: torque swings by {size:.4g} Nm, {values['order']:.4g} times a turn."


EFFECT = TorqueRipple()
