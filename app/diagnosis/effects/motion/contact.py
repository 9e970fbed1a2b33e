"""The flange pushes on something for a while."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import Law, Place, Values, Where
from app.diagnosis.effects.motion._state import State


class Contact(Law):
    key = "contact"
    title = "the flange pushes on something"
    driver = "time"
    equation = "tau = (from_s <= t < to_s) * J^T force"
    units: ClassVar = {"force_x": "N", "force_y": "N", "force_z": "N"}
    linear = ("force_x", "force_y", "force_z")
    windowed = True
    shared = True

    def places(self, state: State) -> list[Place]:
        return [Place({"body": "tool", "driver": "time"})]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        inside = (state.t >= where.get("from_s", -np.inf)) & (state.t < where.get("to_s", np.inf))
        return inside[:, None, None] * state.force_columns

    def explain(self, where: Where, values: Values) -> str:
        force = np.linalg.norm([values[k] for k in self.linear])
        return f"Contact from {where['from_s']:.2f} to {where['to_s']:.2f} s: the flange pushes with {force:.3g} N."


EFFECT = Contact()
