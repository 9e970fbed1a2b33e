"""Torque and position do not belong to the same instant: the torque is recorded late (or early)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.described import Late
from app.diagnosis.effects.dynamic._law import Law, Torques, Values, Where, everywhere
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.hypothesis import Hypothesis
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.kinematics import RobotModel

NOMINAL = 0.01  # s


class Delay(Law):
    key = "delay"
    title = "the torque is recorded late"
    family = "timing"
    driver = "time"
    equation = "tau_recorded(t) = tau(t - delay)"
    units: ClassVar = {"delay": "s"}
    linear = ("delay",)
    undone = True
    follows_load = True
    follows_commands = True

    def places(self, situation: State) -> Iterable[Place]:
        return [Place({"driver": "time"}, {"fixed_delay": situation.hypothesis.delay})]

    def columns(self, columns: State, place: Place) -> Torques:
        return everywhere(-np.gradient(columns.torque, columns.t, axis=0)[:, :, None])

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        return np.array([NOMINAL])

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        return {"delay": place.fixed.get("fixed_delay", 0.0) + float(values[0])}

    def undo(self, hypothesis: Hypothesis, place: Place, values: np.ndarray) -> Hypothesis:
        return replace(hypothesis, delay=self.saved(place, values)["delay"])

    def read_as(self, hypothesis: Hypothesis, where: Where, parameters: Values) -> Hypothesis:
        if "joint" in where:  # late against its command: the torques belong to the measured motion
            return hypothesis
        return replace(hypothesis, delay=hypothesis.delay + parameters["delay"])

    def between(self, now: Hypothesis, before: Hypothesis) -> Iterable[tuple[Where, Values]]:
        if now.delay != before.delay:
            yield {"driver": "time"}, {"delay": now.delay - before.delay}

    def held(self, hypothesis: Hypothesis, place: Place) -> np.ndarray:
        return np.array([hypothesis.delay])

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        if "joint" in where:
            return {}
        late = state.t - parameters["delay"]
        return {j: np.interp(late, state.t, c) - c for j, c in enumerate(state.torque.T)}

    def described(self, robot: RobotModel, where: Where, parameters: Values) -> tuple[Late, ...]:
        return () if "joint" in where or "delay" not in parameters else (Late(parameters["delay"]),)

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        late = "late" if parameters[0].value > 0 else "early"
        return f"Torques are recorded {abs(parameters[0].value):.4g} s {late} against the positions."


EFFECT = Delay()
