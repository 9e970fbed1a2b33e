"""Friction of a joint that stands still: anything up to its breakaway level, whatever the motion before it left."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import Law, Torques
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter

SHORTEST = 0.5  # s: shorter ones are turning points, where friction as such still moves
MOST = 24  # rests of all joints that are looked at, the longest


class RestFriction(Law):
    """One level for every rest of a joint: no law of motion predicts it, and it must not count against one.

    Source: Armstrong-Helouvry, Dupont, Canudas de Wit (1994), A survey of models, analysis tools and compensation
    methods for the control of machines with friction, Automatica 30(7): static friction opposes whatever is applied.
    """

    key = "rest_friction"
    title = "friction of a joint that stands still"
    family = "friction"
    driver = "time"
    equation = "tau = level while qd = 0"
    units: ClassVar = {"level": "Nm"}
    linear = ("level",)
    whole = True
    lasting = False
    standstill = True
    finding = False

    def places(self, situation: State) -> Iterable[Place]:
        found = []
        for j in range(situation.joints):
            still = situation.stands(j)
            edges = np.flatnonzero(np.diff(np.concatenate([[0], still.astype(np.int8), [0]])))
            for first, last in zip(edges[::2], edges[1::2] - 1, strict=True):
                begin, end = float(situation.t[first]), float(situation.t[last])
                if situation.moves(j) and SHORTEST <= end - begin < situation.seconds:
                    found.append((begin - end, j, begin, end))
        return [
            Place({"joint": j + 1, "driver": self.driver, "from_s": begin, "to_s": end})
            for _, j, begin, end in sorted(found)[:MOST]
        ]

    def columns(self, columns: State, place: Place) -> Torques:
        where = place.where
        inside = (columns.t >= where["from_s"] - 1e-9) & (columns.t <= where["to_s"] + 1e-9)
        return {int(where["joint"]) - 1: inside.astype(float)[:, None]}

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        where = place.where
        return (
            f"Joint {where['joint']} stands still from {where['from_s']:.2f} to {where['to_s']:.2f} s and holds "
            f"{parameters[0].value:.3g} Nm by friction."
        )


EFFECT = RestFriction()
