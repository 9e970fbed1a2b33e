"""The log is written down otherwise than its header says: senses, order, units, gravity left out, a slow clock."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import combinations

import numpy as np

from app.diagnosis.effects.dynamic._law import Law, Torques, Values, Where
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, Read, Trial
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.units import DEG_PER_RAD

#: Kinds, as saved in `fixed_kind`.
(
    TORQUE_SENSE,
    TORQUE_ORDER,
    PLACE_SENSE,
    PLACE_ORDER,
    BOTH_ORDER,
    PLACE_UNIT,
    CLOCK,
    NO_GRAVITY,
    ALL_SENSES,
) = range(9)
_NAMES = {
    TORQUE_SENSE: "torque_sense", TORQUE_ORDER: "torque_order", PLACE_SENSE: "joint_sense", PLACE_ORDER: "joint_order",
    BOTH_ORDER: "joints_swapped", PLACE_UNIT: "angle_unit", CLOCK: "clock", NO_GRAVITY: "no_gravity",
    ALL_SENSES: "torque_senses",
}  # fmt: skip
_SAID = {
    TORQUE_SENSE: "the torque of joint {joint} is counted the other way round",
    TORQUE_ORDER: "the torques of joints {joint} and {other} are changed over",
    PLACE_SENSE: "joint {joint} is counted the other way round",
    PLACE_ORDER: "the positions of joints {joint} and {other} are changed over",
    BOTH_ORDER: "joints {joint} and {other} are changed over",
    PLACE_UNIT: "{whose} true at {value:.4g} times what is written: degrees and radians are changed over",
    CLOCK: "the clock runs at the wrong speed: a recorded second lasts {value:.4g} s",
    NO_GRAVITY: "the torques are recorded without the part that gravity makes",
    ALL_SENSES: "all torques are counted the other way round",
}


class WrongConvention(Law):
    """A hypothesis of the whole log, tried out one by one: it is far from linear."""

    key = "wrong_convention"
    title = "written down in another convention"
    family = "conventions"
    equation = "q_true = -q, or joints, units or directions changed over"
    undone = True
    whole_log = True

    def places(self, situation: State) -> Iterable[Place]:
        return []

    def columns(self, columns: State, place: Place) -> Torques:
        return {}

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        return {}

    def readings(self, now: Hypothesis, read: Read) -> Iterable[Trial]:
        n = now.joints

        def convention(kind: int, **where: float) -> Trial:
            fixed = {"fixed_kind": float(kind), **{f"fixed_{k}": float(v) for k, v in where.items()}}
            said = {"joint": int(where["joint"])} if "joint" in where else {}
            if "other" in where:
                said["source_joint"] = int(where["other"])
            return Trial(self, Place({**said, "kind": _NAMES[kind]}, fixed), _read(now, fixed))

        for j in range(1, n + 1):
            yield convention(TORQUE_SENSE, joint=j)
            yield convention(PLACE_SENSE, joint=j)
        for a, b in combinations(range(1, n + 1), 2):
            for kind in (TORQUE_ORDER, PLACE_ORDER, BOTH_ORDER):
                yield convention(kind, joint=a, other=b)
        if n > 1:
            yield convention(ALL_SENSES)
        for value in (DEG_PER_RAD, 1.0 / DEG_PER_RAD):
            yield convention(PLACE_UNIT, value=value)
            for j in range(1, n + 1):
                yield convention(PLACE_UNIT, joint=j, value=value)
        for value in (0.5, 2.0):
            yield convention(CLOCK, value=value)
        if np.any(now.gravity):
            yield convention(NO_GRAVITY)

    def read_as(self, hypothesis: Hypothesis, where: Where, parameters: Values) -> Hypothesis:
        return _read(hypothesis, parameters)

    def undo(self, hypothesis: Hypothesis, place: Place, values: np.ndarray) -> Hypothesis:
        return _read(hypothesis, place.fixed)

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        """The factor of a unit or a clock; the other kinds have no number."""
        factor = place.fixed.get("fixed_value")
        return () if factor is None else (Parameter("factor", float(factor), 0.0, ""),)

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        fixed = place.fixed
        whose = (
            f"the positions of joint {int(fixed['fixed_joint'])} are"
            if "fixed_joint" in fixed
            else "positions are"
        )
        said = _SAID[int(fixed["fixed_kind"])].format(
            joint=int(fixed.get("fixed_joint", 0)), other=int(fixed.get("fixed_other", 0)),
            value=fixed.get("fixed_value", 1.0), whose=whose,
        )  # fmt: skip
        return f"The log is written down in another convention: {said}."


def _read(hypothesis: Hypothesis, fixed: Values) -> Hypothesis:
    """The hypothesis with one convention more undone; fixed values as saved, joints from 1."""
    n, kind = hypothesis.joints, int(fixed["fixed_kind"])
    joint, other = (int(fixed.get(k, 1)) - 1 for k in ("fixed_joint", "fixed_other"))
    if kind in (TORQUE_SENSE, PLACE_SENSE):
        name = "sense" if kind == TORQUE_SENSE else "place_sense"
        senses: list[int] = list(getattr(hypothesis, name) or [1] * n)
        senses[joint] *= -1
        return replace(hypothesis, **{name: tuple(senses)})
    if kind in (TORQUE_ORDER, PLACE_ORDER, BOTH_ORDER):
        out = hypothesis
        for name in {TORQUE_ORDER: ("order",), PLACE_ORDER: ("place_order",)}.get(
            kind, ("order", "place_order")
        ):
            order: list[int] = list(getattr(out, name) or range(n))
            order[joint], order[other] = order[other], order[joint]
            out = replace(out, **{name: tuple(order)})
        return out
    if kind == ALL_SENSES:
        return replace(hypothesis, sense=tuple(-s for s in hypothesis.sense or (1,) * n))
    if kind == PLACE_UNIT:
        factor = np.array(hypothesis.place_factor or [1.0] * n)
        factor[joint if "fixed_joint" in fixed else slice(None)] *= fixed["fixed_value"]
        return replace(hypothesis, place_factor=tuple(map(float, factor)))
    if kind == CLOCK:
        return replace(hypothesis, clock=hypothesis.clock * fixed["fixed_value"])
    return replace(hypothesis, gravity=np.zeros(3))


EFFECT = WrongConvention()
