"""Dry friction that falls with time, or with the joint's temperature where that is recorded."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Torques, Values, Where, choice, direction
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter

SHARES = (0.08, 0.15, 0.25, 0.4, 0.6, 1.0)  # of the log's length: time constants tried
WARMS = 1.0  # degC a joint must warm up by before its friction can be seen to follow


class WarmupFriction(JointLaw):
    key = "warmup_friction"
    title = "friction that falls as the joint warms up"
    family = "friction"
    driver = "time"
    equation = (
        "tau = cold * exp(-t / time_constant) * sign(qd), or per_degree * (warm - temperature) * sign(qd)"
    )
    units: ClassVar = {"cold": "Nm", "time_constant": "s", "per_degree": "Nm/degC", "warm": "degC"}
    blunt = True
    linear = ("cold",)
    bent: ClassVar = {"time_constant": 0.7}

    def places(self, situation: State) -> Iterable[Place]:
        out = list(super().places(situation))
        for j in range(situation.joints):
            warmth = None if situation.temperature is None else situation.temperature[:, j]
            if situation.moves(j) and warmth is not None and np.ptp(warmth) > WARMS:
                # Counted from the warmest on: the rest is ordinary dry friction.
                warm = {"warm": float(np.ceil(warmth.max()))}
                out.append(Place({"joint": j + 1, "driver": "temperature"}, warm))
        return out

    def forms(self, state: State, joint: int) -> list[tuple[Values, float]]:
        times = [share * state.seconds for share in SHARES]
        return [({"time_constant": time}, choice(len(SHARES)) / 2) for time in times]

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        if "warm" not in fixed:
            cold = np.exp(-state.t / fixed["time_constant"])
        elif state.temperature is None:
            cold = np.zeros(len(state.t))  # a log without temperatures: the joint counts as warm
        else:
            cold = fixed["warm"] - state.temperature[:, joint]
        return (cold * direction(state, joint, fixed))[:, None]

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        return {"per_degree" if "warm" in place.fixed else "cold": float(values[0]), **place.fixed}

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        found = super().reported(place, values, covariance)
        std = float(np.sqrt(max(covariance[0, 0], 0.0)))
        return tuple(replace(p, std=std) if p.name == "per_degree" else p for p in found)

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        size = parameters.get("per_degree", parameters.get("cold", 0.0))
        return {j: size * c[:, 0] for j, c in self.columns(state, Place(where, dict(parameters))).items()}

    def lawful(self, parameters: Values) -> bool:
        return parameters.get("cold", parameters.get("per_degree", 0.0)) > 0


EFFECT = WarmupFriction()
