"""From a log to windows: the description's torque, what is linear in it, and the torque that was measured.

A long log is averaged over windows: torque and every column alike, which keeps what is linear linear. The mean of
a rigid-body column over a window is taken from two points of it (Gauss's rule, exact for cubics).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.models.dynamic.every_sample import EverySample, moved
from app.diagnosis.models.dynamic.hypothesis import Hypothesis
from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.thresholds.friction import SHARP, STILL
from app.kinematics import RobotModel
from app.kinematics.dynamics import (
    PER_LINK,
    flange_to_last_link,
    gravity_and_wrench_columns,
    inertial_parameters,
)
from app.kinematics.regressor import torque_regressor

ENOUGH = 3_000  # windows wanted before samples are averaged at all
MOST = 4_500  # windows a fit works on; of longer logs they are taken evenly
LONGEST = 0.02  # s: a window lasts no longer; speed and acceleration are smoothed over more than that anyway
KEPT = 4  # hypotheses of a log whose windows are kept, 15 MB each
SMALLEST_SIZE = 1e-3  # of the largest joint's torque: below it nothing is measured
SMALLEST_LINK = 0.05  # m, and
LIGHTEST_LINK = 0.1  # kg: below them a link's masses say nothing of how far they can be off


@dataclass(frozen=True, eq=False)
class Samples:
    """What a fit works on.

    Args:
        state: M windows.
        y: (M, n) measured torque [Nm], as the hypothesis reads it.
        nominal: (10 n,) the description's inertial parameters.
        used: (M, n) False where a window's torque was set aside, or never changes: nothing is measured there.
        unspiked: (M, n) False where it was set aside.
        first: (M,) the log's first sample of each window.
        step: time between windows [s].
        window: samples averaged in each.
        within: (n,) mean square [Nm^2] that averaging took away of the torque.
    """

    state: State
    y: np.ndarray
    nominal: np.ndarray
    used: np.ndarray
    unspiked: np.ndarray
    first: np.ndarray
    step: float
    window: int
    within: np.ndarray

    @property
    def centre(self) -> np.ndarray:
        """(M,) the log's sample in the middle of each window."""
        return self.first + self.window // 2

    @property
    def alive(self) -> np.ndarray:
        """(n,) True where a torque is measured."""
        return np.asarray(self.used.any(axis=0))

    @property
    def description(self) -> np.ndarray:
        """(M, n) the description's torque [Nm]."""
        return self.state.regressor @ self.nominal


class Taker:
    """Windows of one log under any hypothesis about how it was recorded; those of the last ones are kept.

    Args:
        few: about so many windows instead of all.
    """

    def __init__(self, log: Log, robot: RobotModel, motion: Motion, few: int = 0):
        self.log, self.robot, self.motion, self.few = log, robot, motion, few
        self._kept: dict[tuple, Samples] = {}

    def __call__(self, hypothesis: Hypothesis) -> Samples:
        key, moves = hypothesis.key, hypothesis.moves
        alike = next((k for k in self._kept if k == key), None)
        alike = next((k for k in self._kept if k[: len(moves)] == moves), None) if alike is None else alike
        if alike is None:
            found = take(self.log, self.robot, self.motion, hypothesis, few=self.few)
        else:
            found = self._kept[alike] = self._kept.pop(alike)  # the last that is let go
            found = found if alike == key else _read(self.log, found, hypothesis)
        self._kept[key] = found
        if len(self._kept) > KEPT:
            del self._kept[next(iter(self._kept))]
        return found


def _read(log: Log, alike: Samples, hypothesis: Hypothesis) -> Samples:
    """Windows of the same motion, their torques read otherwise."""
    y = _torques(log, alike.first, alike.window, hypothesis)
    pooled, rigid = y.mean(axis=1), alike.state.torque
    every = None if alike.state.every is None else replace(alike.state.every, hypothesis=hypothesis)
    state = replace(alike.state, hypothesis=hypothesis, size=_size(rigid, pooled), every=every)
    used = alike.unspiked & (np.ptp(pooled, axis=0) > 0)
    return replace(alike, state=state, y=pooled, used=used, within=_within(y, rigid))


def _torques(log: Log, first: np.ndarray, window: int, hypothesis: Hypothesis) -> np.ndarray:
    """(M, w, n) measured torque of every sample of every window."""
    index = first[:, None] + np.arange(window)
    return hypothesis.torque(log.y[index].reshape(-1, log.y.shape[1])).reshape(*index.shape, -1)


def take(log: Log, robot: RobotModel, motion: Motion, hypothesis: Hypothesis, *, few: int = 0) -> Samples:
    """Windows of a log under a hypothesis about how it was recorded.

    Args:
        few: about so many windows instead of all.
    """
    first, window = _windows(log, few)
    index = first[:, None] + np.arange(window)
    # (M, w, n) each: a long log has hundreds of samples for each that a window needs.
    q, qd, qdd = (
        hypothesis.motion(values.reshape(-1, values.shape[-1]), order).reshape(*index.shape, -1)
        for order, values in enumerate(moved(log, motion, index, hypothesis))
    )
    at = _points(first, window) - np.repeat(first, 1 if window == 1 else 2)
    points = 1 if window == 1 else 2
    place, speed, push = (_between(values, at) for values in (q, qd, qdd))
    regressor = np.asarray(torque_regressor(robot, place, speed, push, gravity=hypothesis.gravity))
    if points == 2:
        regressor = _halves(regressor)

    def levers() -> tuple[np.ndarray, np.ndarray]:
        gravity, wrench = gravity_and_wrench_columns(robot, place)
        return (gravity, wrench) if points == 1 else (_halves(gravity), _halves(wrench))

    nominal = inertial_parameters(robot)
    rigid = regressor @ nominal
    y = _torques(log, first, window, hypothesis)
    unspiked = np.ones((len(first), y.shape[2]), bool)
    if log.spiked.any():
        unspiked = np.asarray(~log.spiked[index].any(axis=1))
    t = (log.t[index].mean(axis=1) - log.t[0]) * hypothesis.clock
    mean = [v.mean(axis=1) if window > 1 else v[:, 0] for v in (q, qd, qdd)]
    pooled = y.mean(axis=1)
    mass, size = _links(robot)
    state = State(
        hypothesis=hypothesis,
        t=t, q=mean[0], qd=mean[1], qdd=mean[2], fine=qd, regressor=regressor, torque=rigid, drive=rigid,
        levers=levers,
        payload_columns=regressor[:, :, -PER_LINK:] @ flange_to_last_link(robot),
        temperature=None if log.temperature is None else log.temperature[first + window // 2],
        commanded=None if log.commanded is None else log.commanded[first + window // 2],
        speed=np.quantile(np.abs(mean[1]), 0.9, axis=0), seconds=float(t[-1]),
        window=window * log.step * hypothesis.clock,
        sliding=np.array([joint.prismatic for joint in robot.joints]),
        width=np.maximum(SHARP, motion.speed_noise), slip=np.zeros(robot.joint_count),
        still=STILL * np.maximum(SHARP, motion.speed_noise),
        size=_size(rigid, pooled),
        link_mass=mass, link_size=size,
        every=EverySample(log, robot, motion, hypothesis, nominal, first, window),
    )  # fmt: skip
    wide = float(np.median(np.diff(t))) if len(t) > 1 else log.step
    alive = np.ptp(pooled, axis=0) > 0
    return Samples(
        state, pooled, nominal, np.asarray(unspiked & alive), unspiked, first, wide, window, _within(y, rigid)
    )


def _size(rigid: np.ndarray, y: np.ndarray) -> np.ndarray:
    size = np.maximum(np.sqrt(np.mean(rigid**2, axis=0)), 0.3 * np.sqrt(np.mean(y**2, axis=0)))
    return np.maximum(size, SMALLEST_SIZE * max(float(size.max()), 1e-6))


def _links(robot: RobotModel) -> tuple[np.ndarray, np.ndarray]:
    """(n,) mass [kg] and size [m] of each link: radius of gyration, lever or half the way to the next joint."""
    inertias = list(robot.model.inertias)[1:]
    nexts = np.linalg.norm(np.asarray(robot.chain.translations), axis=1)
    mass = np.array([max(i.mass, LIGHTEST_LINK) for i in inertias])
    size = [
        max(
            SMALLEST_LINK,
            float(np.sqrt(max(np.trace(i.inertia), 0.0) / 2 / m)),
            float(np.linalg.norm(i.lever)),
            0.5 * float(nexts[k + 1]) if k + 1 < len(nexts) else 0.0,
        )
        for k, (i, m) in enumerate(zip(inertias, mass, strict=True))
    ]
    return mass, np.array(size)


def _within(y: np.ndarray, rigid: np.ndarray) -> np.ndarray:
    """(n,) mean square of the noise that averaging took away; y (M, w, n), the line through each window taken off."""
    window = y.shape[1]
    if window == 1:
        return np.zeros(y.shape[2])
    own = y - y.mean(axis=1, keepdims=True)
    if window == 2:
        change = np.diff(y[:, :, :], axis=1)[:, 0]
        slow = np.gradient(rigid, axis=0) / 2
        return np.mean((change - slow) ** 2, axis=0) / 4
    line = np.arange(window) - 0.5 * (window - 1)
    slope = np.einsum("k,mkn->mn", line, own) / (line @ line)
    own = own - slope[:, None] * line[:, None]
    return np.mean(own**2, axis=(0, 1)) * (window - 1) / (window - 2)


def _windows(log: Log, few: int) -> tuple[np.ndarray, int]:
    """First sample of each window (M,), and their length."""
    total = len(log.t)
    enough, most = (few, few) if few else (ENOUGH, MOST)
    longest = max(1, int(LONGEST / log.step + 1e-6))
    window = 1 if few else int(np.clip(total // enough, 1, longest))
    every = max(1, int(np.ceil(total / window / most)))
    starts = [np.arange(s.start, s.stop - window + 1, window * every) for s in log.segments]
    return np.concatenate(starts), window


def _points(first: np.ndarray, window: int) -> np.ndarray:
    if window == 1:
        return first.astype(float)
    spread = np.sqrt((window**2 - 1) / 12.0)  # standard deviation of the samples' places
    return (first[:, None] + 0.5 * (window - 1) + spread * np.array([-1.0, 1.0])).reshape(-1)


def _between(values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Values of windows (M, w, n) at places within them, one or two a window, counted in samples from its first."""
    window = np.repeat(np.arange(len(values)), len(at) // len(values))
    low = np.clip(at.astype(int), 0, max(values.shape[1] - 2, 0))
    share = (at - low)[:, None]
    lower = values[window, low]
    return lower if not share.any() else lower + share * (values[window, low + 1] - lower)


def _halves(values: np.ndarray) -> np.ndarray:
    return 0.5 * (values[::2] + values[1::2])
