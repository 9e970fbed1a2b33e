"""How a log is to be read, before anything else: mounting, senses, order, units, clock.

Under each reading friction, rotor and offset of every joint are fitted beside the description, and what is left is held
against what is left of the log as it is given. A reading is taken where it leaves plainly less on all joints together;
then the others are tried again on top of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from app.diagnosis.dynamic.masses import masses_do_worse
from app.diagnosis.effects.dynamic import wrong_convention as kinds
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, as_given
from app.diagnosis.models.dynamic.samples import Samples, Taker
from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.thresholds.readings import (
    BETTER,
    COST,
    EACH_LEAVES,
    FACTOR,
    GROSS,
    LEAVES,
    LOOKED_AT,
    TILTED,
    TOGETHER,
)
from app.kinematics import RobotModel
from app.kinematics.robot import GRAVITY
from app.units import DEG_PER_RAD

ROUNDS = 4
EACH = "each"  # factors of the joints one by one


@dataclass(frozen=True, eq=False)
class Reading:
    """A log as it is to be read.

    Args:
        places: what was undone, key of the effect and place.
        share: of the torques' variance that is left, 0..1.
    """

    hypothesis: Hypothesis
    places: tuple[tuple[str, Place], ...] = ()
    share: float = 0.0


def reading_of(log: Log, robot: RobotModel, motion: Motion) -> Reading:
    """The reading of a log that its torques ask for; as given where the description has no masses."""
    given = as_given(robot.joint_count)
    now = Reading(given)
    if not robot.has_inertials:
        return now
    look = Taker(log, robot, motion, few=LOOKED_AT)
    best = Unread(look(given))
    now = replace(now, share=best.share)
    for _ in range(ROUNDS):
        if best.share < GROSS:
            break
        trials = []
        for key, place, hypothesis in _trials(now.hypothesis, best):
            fit = Unread(look(hypothesis))
            if fit.share > (EACH_LEAVES if place.where.get("kind") == EACH else LEAVES * best.share):
                continue
            fitted = hypothesis.joints if place.where.get("kind") == EACH else 1
            trials.append((best.better(fit, fitted), key, place, hypothesis, fit))
        if not trials:
            break
        gain, key, place, hypothesis, fit = max(trials, key=lambda trial: trial[0])
        if gain < COST or best.nepers(fit) < BETTER:
            break
        if place.where.get("kind") == EACH and not masses_do_worse(best, fit):
            break
        now, best = Reading(hypothesis, (*now.places, (key, place)), fit.share), fit
    return now


class Unread:
    """What friction, rotor and offset leave of each joint under one reading."""

    def __init__(self, samples: Samples):
        self.samples, state = samples, samples.state
        beyond = samples.y - samples.description
        rows, n = beyond.shape
        self.left, self.basis = np.empty(n), []
        spread = np.maximum(np.std(samples.y, axis=0), 0.02 * float(np.std(samples.y, axis=0).max()) + 1e-12)
        for j in range(n):
            columns = np.stack([state.direction(j), state.qd[:, j], state.qdd[:, j], np.ones(rows)], axis=1)
            size = np.sqrt(np.mean(columns**2, axis=0))
            basis, r = np.linalg.qr(columns[:, size > 1e-9] / size[size > 1e-9])
            basis = basis[:, np.abs(np.diag(r)) > 1e-6]
            self.basis.append(basis)
            rest = beyond[:, j] - basis @ (basis.T @ beyond[:, j])
            self.left[j] = np.sqrt(np.mean(rest**2)) / spread[j] + 1e-3 if samples.alive[j] else 1.0
        self.share = float(np.mean(np.minimum(self.left**2, 1.0)))

    def nepers(self, other: Unread) -> float:
        """By how much another reading leaves less, mean over the joints."""
        return float(np.mean(np.log(self.left) - np.log(other.left)))

    def better(self, other: Unread, fitted: int) -> float:
        """nats by which another reading is better."""
        rows = len(self.samples.y) / TOGETHER
        return rows * self.nepers(other) * len(self.left) - 0.5 * fitted * float(np.log(rows))

    def off(self, j: int, values: np.ndarray) -> np.ndarray:
        """Values (M, ...) of joint j with friction projected off."""
        return values - self.basis[j] @ (self.basis[j].T @ values)


def _trials(now: Hypothesis, fit: Unread) -> Iterator[tuple[str, Place, Hypothesis]]:
    n = now.joints

    def convention(kind: int, **where: float) -> tuple[str, Place, Hypothesis]:
        fixed = {"fixed_kind": float(kind), **{f"fixed_{k}": float(v) for k, v in where.items()}}
        said = {"joint": int(where["joint"])} if "joint" in where else {}
        if "other" in where:
            said["source_joint"] = int(where["other"])
        place = Place({**said, "kind": _NAMES[kind]}, fixed)
        return "wrong_convention", place, kinds.read(now, fixed)

    for j in range(1, n + 1):
        yield convention(kinds.TORQUE_SENSE, joint=j)
        yield convention(kinds.PLACE_SENSE, joint=j)
    for a, b in combinations(range(1, n + 1), 2):
        for kind in (kinds.TORQUE_ORDER, kinds.PLACE_ORDER, kinds.BOTH_ORDER):
            yield convention(kind, joint=a, other=b)
    if n > 1:
        yield convention(kinds.ALL_SENSES)
    for value in (DEG_PER_RAD, 1.0 / DEG_PER_RAD):
        yield convention(kinds.PLACE_UNIT, value=value)
        for j in range(1, n + 1):
            yield convention(kinds.PLACE_UNIT, joint=j, value=value)
    for value in (0.5, 2.0):
        yield convention(kinds.CLOCK, value=value)
    if np.any(now.gravity):
        yield convention(kinds.NO_GRAVITY)
        yield from _mounting(now, fit)
    yield from _factors(now, fit)


_NAMES = {
    kinds.TORQUE_SENSE: "torque_sense", kinds.TORQUE_ORDER: "torque_order", kinds.PLACE_SENSE: "joint_sense",
    kinds.PLACE_ORDER: "joint_order", kinds.BOTH_ORDER: "joints_swapped", kinds.PLACE_UNIT: "angle_unit",
    kinds.CLOCK: "clock", kinds.NO_GRAVITY: "no_gravity", kinds.ALL_SENSES: "torque_senses",
}  # fmt: skip


def _mounting(now: Hypothesis, fit: Unread) -> Iterator[tuple[str, Place, Hypothesis]]:
    """Gravity by three numbers (it is linear), its size as it is everywhere."""
    samples = fit.samples
    beyond, gram, right = samples.y - samples.description, np.zeros((3, 3)), np.zeros(3)
    weight = samples.alive / np.maximum(np.std(samples.y, axis=0), 1e-9) ** 2
    for j in range(now.joints):
        columns = fit.off(j, samples.state.gravity_columns[:, j])
        gram += weight[j] * columns.T @ columns
        right += weight[j] * columns.T @ beyond[:, j]
    g = now.gravity + np.linalg.solve(gram + 1e-9 * np.trace(gram) * np.eye(3), right)
    size = float(np.linalg.norm(g))
    if size < 1.0:
        return
    leaning = replace(now, gravity=g * float(np.linalg.norm(GRAVITY)) / size)
    if leaning.tilt * DEG_PER_RAD > TILTED:
        g = map(float, leaning.gravity)
        fixed: dict[str, float] = dict(zip(("fixed_gx", "fixed_gy", "fixed_gz"), g, strict=True))
        yield "gravity_direction", Place({"body": "base", "driver": "gravity_torque"}, fixed), leaning


def _factors(now: Hypothesis, fit: Unread) -> Iterator[tuple[str, Place, Hypothesis]]:
    """One factor of all torques, and one of each joint."""
    samples = fit.samples
    both = np.zeros((2, now.joints))
    weight = 1.0 / np.maximum(np.std(samples.y, axis=0), 1e-9) ** 2
    for j in range(now.joints):
        rigid = fit.off(j, samples.description[:, j])
        both[:, j] = rigid @ samples.y[:, j], rigid @ rigid
    alive = samples.alive
    both, weight = both * alive, weight * alive
    each = both[0] / np.maximum(both[1], 1e-300)
    one = float((both[0] * weight).sum() / max(float((both[1] * weight).sum()), 1e-300))
    if one > 0 and abs(np.log(one)) > np.log(FACTOR):
        factor = tuple(map(float, now.factors * one))
        yield "torque_constant", Place({}, {"fixed_scale": factor[0] - 1.0}), replace(now, factor=factor)
    each[~alive] = 1.0
    if np.all(each > 0) and np.max(np.abs(np.log(each))) > np.log(FACTOR):
        factor = tuple(map(float, now.factors * each))
        yield "torque_constant", Place({"kind": EACH}, {"fixed_scale": 0.0}), replace(now, factor=factor)
