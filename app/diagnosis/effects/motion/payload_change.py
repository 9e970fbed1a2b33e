"""A load that is taken up (or put down) at some moment of the log."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.motion._law import Place, Values, Where
from app.diagnosis.effects.motion._load import Load
from app.diagnosis.effects.motion._state import State


class PayloadChange(Load):
    key = "payload_change"
    title = "the load on the flange changes"
    driver = "time"
    equation = "tau = (t > from_s) * tau of a mass at its centre in the flange frame"
    windowed = True

    def places(self, state: State) -> list[Place]:
        return [Place({"body": "tool", "driver": "time"})]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return _after(state, where)[:, None, None] * state.payload_columns

    def apply(
        self, state: State, where: Where, values: Values, torque: np.ndarray | None = None
    ) -> np.ndarray:
        return _after(state, where)[:, None] * (state.payload_columns @ self.body(values))

    def explain(self, where: Where, values: Values) -> str:
        what = "taken up" if values["mass"] > 0 else "put down"
        return (
            f"A load of {abs(values['mass']):.3f} kg is {what} at {where['from_s']:.2f} s, its centre at "
            f"({values['com_x']:.3f}, {values['com_y']:.3f}, {values['com_z']:.3f}) m."
        )


def _after(state: State, where: Where) -> np.ndarray:
    inside = state.t >= where.get("from_s", -np.inf)
    return inside & (state.t < where.get("to_s", np.inf))


EFFECT = PayloadChange()
