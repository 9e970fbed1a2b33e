"""Dry friction that falls with time, or with the joint's temperature where that is recorded."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import JointLaw, Place, Values, Where, joint_of
from app.diagnosis.effects.motion._state import State

SHARES = (0.08, 0.2, 0.45, 1.0)  # of the log's length: time constants tried
WARMS = 1.0  # degC a joint must warm up by before its friction can be seen to follow


class WarmupFriction(JointLaw):
    key = "warmup_friction"
    title = "friction that falls as the joint warms up"
    driver = "time"
    equation = (
        "tau = cold * exp(-t / time_constant) * sign(qd), or per_degree * (warm - temperature) * sign(qd)"
    )
    units: ClassVar = {"cold": "Nm", "time_constant": "s", "per_degree": "Nm/degC", "warm": "degC"}
    linear = ("cold",)
    resists = True
    shape_bounds: ClassVar = {"time_constant": (0.2, 1e5)}

    def places(self, state: State) -> list[Place]:
        out = []
        for j in range(state.joints):
            if not state.moves(j):
                continue
            where = {"joint": j + 1, "driver": "time"}
            out += [Place(where, {"time_constant": share * state.seconds}) for share in SHARES]
            if state.temperature is not None and np.ptp(state.temperature[:, j]) > WARMS:
                # Counted from the warmest on: the rest is ordinary dry friction.
                warm = float(np.ceil(state.temperature[:, j].max()))
                out.append(Place({"joint": j + 1, "driver": "temperature"}, {"warm": warm}))
        return out

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        j = joint_of(where)
        if "warm" not in shape:
            cold = np.exp(-state.t / shape["time_constant"])
        elif state.temperature is None:
            cold = np.zeros(len(state.t))  # a log without temperatures: the joint counts as warm
        else:
            cold = shape["warm"] - state.temperature[:, j]
        return (cold * np.sign(state.qd[:, j]))[:, None]

    def values(self, coefficients: np.ndarray, shape: Values) -> dict[str, float]:
        return {"per_degree" if "warm" in shape else "cold": float(coefficients[0]), **shape}

    def apply(
        self, state: State, where: Where, values: Values, torque: np.ndarray | None = None
    ) -> np.ndarray:
        size = values["per_degree"] if "warm" in values else values["cold"]
        shape = {k: v for k, v in values.items() if k in ("warm", "time_constant")}
        return self.columns(state, where, shape)[:, 0] * size

    def lawful(self, values: Values) -> bool:
        return values.get("cold", values.get("per_degree", 0.0)) > 0


EFFECT = WarmupFriction()
