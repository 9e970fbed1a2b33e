"""How a log is to be read, before anything else: mounting, senses, order, units, clock.

Under each reading friction, rotor and offset of every joint are fitted beside the description, and what is left is held
against what is left of the log as it is given. A reading is taken where it leaves plainly less on all joints together;
then the others are tried again on top of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.dynamic.masses import masses_do_worse
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, Trial, as_given
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.samples import Samples, Taker
from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.thresholds.readings import (
    BETTER,
    COST,
    EACH_LEAVES,
    GROSS,
    LEAVES,
    LOOKED_AT,
    TOGETHER,
)
from app.kinematics import RobotModel

ROUNDS = 4


@dataclass(frozen=True, eq=False)
class Reading:
    """A log as it is to be read.

    Args:
        taken: what was undone, one on top of the other.
        share: of the torques' variance that is left, 0..1.
    """

    hypothesis: Hypothesis
    taken: tuple[Trial, ...] = ()
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
        for trial in _trials(now.hypothesis, best):
            fit = Unread(look(trial.hypothesis))
            if fit.share > (EACH_LEAVES if trial.each else LEAVES * best.share):
                continue
            trials.append((best.better(fit, trial.hypothesis.joints if trial.each else 1), trial, fit))
        if not trials:
            break
        gain, trial, fit = max(trials, key=lambda found: found[0])
        if gain < COST or best.nepers(fit) < BETTER:
            break
        if trial.each and not masses_do_worse(best, fit):
            break
        now, best = Reading(trial.hypothesis, (*now.taken, trial), fit.share), fit
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


def _trials(now: Hypothesis, fit: Unread) -> Iterator[Trial]:
    """Conventions first, which have no number, then what is fitted."""
    for law in sorted(laws().values(), key=lambda law: not law.whole_log):
        yield from law.readings(now, fit)
