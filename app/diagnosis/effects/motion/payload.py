"""A load on the flange that the description does not have."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.motion._law import Place, Values, Where
from app.diagnosis.effects.motion._load import Load
from app.diagnosis.effects.motion._state import State


class Payload(Load):
    key = "payload"
    title = "a load on the flange"
    positive = ("mass",)
    equation = "tau = tau of a mass at its centre in the flange frame"

    def places(self, state: State) -> list[Place]:
        return [Place({"body": "tool"})]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return state.payload_columns

    def apply(
        self, state: State, where: Where, values: Values, torque: np.ndarray | None = None
    ) -> np.ndarray:
        return state.payload_columns @ self.body(values)

    def explain(self, where: Where, values: Values) -> str:
        return (
            f"A load of {values['mass']:.3f} kg on the flange, its centre at "
            f"({values['com_x']:.3f}, {values['com_y']:.3f}, {values['com_z']:.3f}) m."
        )


EFFECT = Payload()
