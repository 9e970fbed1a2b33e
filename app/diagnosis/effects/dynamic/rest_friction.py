"""Friction of a joint that stands still: anything up to its breakaway level, whatever the motion before it left.

So it is when a log begins: where friction turns over a way, what it began with fades on that way.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import SLIP, Law, Torques
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter

SHORTEST = 0.5  # s: shorter ones are turning points, where friction as such still moves
MOST = 24  # rests of all joints that are looked at, the longest
GONE = 5.0  # ways on which friction turns, after which nothing is left of what it began with


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
        rests = [
            Place({"joint": j + 1, "driver": self.driver, "from_s": begin, "to_s": end})
            for _, j, begin, end in sorted(found)[:MOST]
        ]
        starts = [self._start(situation, j) for j in range(situation.joints) if situation.slip[j] > 0]
        return [*rests, *starts]

    def _start(self, state: State, joint: int) -> Place:
        """What dry friction of joint (from 0) began with, as long as something is left of it."""
        slip = float(state.slip[joint])
        left = np.flatnonzero(_way(state, joint) < GONE * slip)
        where = {"joint": joint + 1, "driver": self.driver, "from_s": 0.0, "to_s": float(state.t[left[-1]])}
        return Place(where, {SLIP: slip})

    def columns(self, columns: State, place: Place) -> Torques:
        where = place.where
        inside = (columns.t >= where["from_s"] - 1e-9) & (columns.t <= where["to_s"] + 1e-9)
        joint, level = int(where["joint"]) - 1, inside.astype(float)
        if SLIP in place.fixed:
            level = level * np.exp(-_way(columns, joint) / place.fixed[SLIP])
        return {joint: level[:, None]}

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        where = place.where
        return (
            f"Joint {where['joint']} stands still from {where['from_s']:.2f} to {where['to_s']:.2f} s and holds "
            f"{parameters[0].value:.3g} Nm by friction."
        )


def _way(state: State, joint: int) -> np.ndarray:
    """(M,) [rad or m] that joint (from 0) has gone since the start."""
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(state.q[:, joint])))])


EFFECT = RestFriction()
