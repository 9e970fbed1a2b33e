"""A load that is taken up (or put down) at some moment of the log, for good or until another one."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from app.diagnosis.effects.dynamic._law import Where
from app.diagnosis.effects.dynamic._load import Load
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter


class PayloadChange(Load):
    key = "payload_change"
    title = "the load on the flange changes"
    family = "events"
    driver = "time"
    equation = "tau = (from_s < t < to_s) * tau of a mass at its centre in the flange frame"
    ends = ("from_s",)
    until = "to_s"
    hidden = True
    lasting = False

    def places(self, situation: State) -> Iterable[Place]:
        return [Place({"body": "tool", "driver": "time"}, scan=True)]

    def active(self, state: State, where: Where) -> np.ndarray:
        inside = (state.t >= where.get("from_s", -np.inf)) & (state.t < where.get("to_s", np.inf))
        return inside.astype(float)

    def shape(self, state: State, place: Place) -> np.ndarray:
        return self.active(state, place.where)

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        values = {p.name: p.value for p in parameters}
        what, back = ("taken up", "put down") if values["mass"] > 0 else ("put down", "taken up")
        until = f" and {back} at {place.where['to_s']:.2f} s" if "to_s" in place.where else ""
        return (
            f"A load of {abs(values['mass']):.3f} kg is {what} at {place.where['from_s']:.2f} s{until}, its centre at "
            f"({values['com_x']:.3f}, {values['com_y']:.3f}, {values['com_z']:.3f}) m."
        )


EFFECT = PayloadChange()
