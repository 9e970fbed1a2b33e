"""A torque is recorded by a wrong factor: a wrong drive gain or sensor scale, of one joint or of all."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.described import Gain
from app.diagnosis.effects.dynamic._law import JointLaw, Torques, Values, Where
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, Read, Trial
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.diagnosis.thresholds.evidence import GAIN_SPREAD, SAME_DRIVE
from app.diagnosis.thresholds.readings import FACTOR
from app.estimation import plus_minus
from app.kinematics import RobotModel

NOMINAL = 0.3  # drive gains of a maker differ by some percent; one that was taken for another by tens
SMALLEST, LARGEST = (
    5e-4,
    2e3,
)  # factors that a torque may be recorded by: millinewton-metres for newton-metres
CURRENT = 0.25  # drives of arms give 4 Nm and more for an ampere, seen through the gear


DRIVE = "drive"  # marks the small factors of all drives at once


class TorqueConstant(JointLaw):
    key = "torque_constant"
    title = "its torque is recorded by a wrong factor"
    family = "drive"
    driver = ""
    located_by = ()
    equation = "tau_recorded = (1 + scale) * tau"
    units: ClassVar = {"scale": ""}
    linear = ("scale",)
    undone = True
    gain = True
    whole = True
    between_logs = SAME_DRIVE
    apart = True
    sure = True
    spread = ((GAIN_SPREAD / NOMINAL) ** 2,)  # of all drives at once, as they are made
    beside = "link_inertia"  # masses are less sure than drives
    follows_load = True
    clashes = ("link_inertia",)

    def places(self, situation: State) -> Iterable[Place]:
        done = situation.hypothesis.factors - 1.0
        alike = not np.ptp(done) or np.any(done <= -1.0)
        common = float(done[0]) if alike else float(np.exp(np.mean(np.log1p(done)))) - 1.0
        every = [Place({}, {"fixed_scale": common}, member=False)] if situation.joints > 1 else []
        own = [Place({"joint": j + 1}, {"fixed_scale": float(s)}, member=False) for j, s in enumerate(done)]
        drives = [
            Place({"joint": j + 1}, {"fixed_scale": float(s), DRIVE: 1.0}, alone=False)
            for j, s in enumerate(done)
        ]
        return [*every, *own, *drives]

    def columns(self, columns: State, place: Place) -> Torques:
        joints = [int(place.where["joint"]) - 1] if "joint" in place.where else range(columns.joints)
        return {j: self.column(columns, j, place.fixed) for j in joints}

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        # A large factor is undone in the log; of a small one the column is all that it scales, friction too.
        return (state.drive if DRIVE in fixed else state.torque)[:, joint, None]

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        return {"scale": (1.0 + place.fixed.get("fixed_scale", 0.0)) * (1.0 + float(values[0])) - 1.0}

    def undo(self, hypothesis: Hypothesis, place: Place, values: np.ndarray) -> Hypothesis:
        return _scaled(hypothesis, place.where, float(values[0]))

    def readings(self, now: Hypothesis, read: Read) -> Iterable[Trial]:
        """One factor of all torques, and one of each joint."""
        samples = read.samples
        both = np.zeros((2, now.joints))
        weight = 1.0 / np.maximum(np.std(samples.y, axis=0), 1e-9) ** 2
        for j in range(now.joints):
            rigid = read.off(j, samples.description[:, j])
            both[:, j] = rigid @ samples.y[:, j], rigid @ rigid
        both, weight = both * samples.alive, weight * samples.alive
        each = both[0] / np.maximum(both[1], 1e-300)
        one = float((both[0] * weight).sum() / max(float((both[1] * weight).sum()), 1e-300))
        if one > 0 and abs(np.log(one)) > np.log(FACTOR):
            factor = tuple(map(float, now.factors * one))
            yield Trial(self, Place({}, {"fixed_scale": factor[0] - 1.0}), replace(now, factor=factor))
        each[~samples.alive] = 1.0
        if np.all(each > 0) and np.max(np.abs(np.log(each))) > np.log(FACTOR):
            factor = tuple(map(float, now.factors * each))
            yield Trial(self, Place({}, {"fixed_scale": 0.0}), replace(now, factor=factor), each=True)

    def read_as(self, hypothesis: Hypothesis, where: Where, parameters: Values) -> Hypothesis:
        return _scaled(hypothesis, where, parameters["scale"])

    def between(self, now: Hypothesis, before: Hypothesis) -> Iterable[tuple[Where, Values]]:
        scale = now.factors / before.factors - 1.0
        if now.joints > 1 and np.allclose(scale, scale[0], rtol=1e-9) and scale[0]:
            yield {}, {"scale": float(scale[0])}
            return
        for j in np.flatnonzero(scale):
            yield {"joint": int(j) + 1}, {"scale": float(scale[j])}

    def held(self, hypothesis: Hypothesis, place: Place) -> np.ndarray:
        return np.array([hypothesis.factors[int(place.where.get("joint", 1)) - 1] - 1.0])

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        return {j: parameters["scale"] * c[:, 0] for j, c in self.columns(state, Place(where)).items()}

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        return np.array([NOMINAL])

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        std = float(np.sqrt(max(covariance[0, 0], 0.0))) * (1.0 + place.fixed.get("fixed_scale", 0.0))
        return (Parameter("scale", self.saved(place, values)["scale"], std, ""),)

    def lawful(self, parameters: Values) -> bool:
        return SMALLEST < 1.0 + parameters["scale"] < LARGEST

    def described(self, robot: RobotModel, where: Where, parameters: Values) -> tuple[Gain, ...]:
        factor = 1.0 + parameters.get("scale", -1.0)
        joint = int(where["joint"]) if "joint" in where else None
        return (Gain(factor, joint),) if factor > 0.0 else ()

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        factor = 1.0 + parameters[0].value
        times = plus_minus(factor, parameters[0].std)
        current = " Are these motor currents?" if factor < CURRENT else ""
        if "joint" in place.where:
            said = f"The torque of joint {place.where['joint']} is recorded at {times} of what it is."
            return said + current
        return (
            f"The torques are {times} times the description's in every joint: "
            f"torque factor or masses, this log cannot tell which.{current}"
        )


def _scaled(hypothesis: Hypothesis, where: Where, scale: float) -> Hypothesis:
    """The hypothesis with the factor of a joint, or of all, 1 + scale times as large."""
    factor = hypothesis.factors
    factor[[int(where["joint"]) - 1] if "joint" in where else slice(None)] *= 1.0 + scale
    return replace(hypothesis, factor=tuple(map(float, factor)))


EFFECT = TorqueConstant()
