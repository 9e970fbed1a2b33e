"""From a log to the samples a fit works on: smoothed motion, the description's columns, windows, blocks.

A long log is pooled: torque is averaged over short windows, and so is every column, which keeps what is linear
exactly linear. The mean of a column over a window is taken from two points of it (Gauss's rule on its samples,
exact for cubics): the motion is smooth, the torque's noise is not. Where the windows would be too many, they
are taken evenly over the whole log.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.effects.motion._state import State
from app.diagnosis.motion.filters import Smoothing, differentiate
from app.diagnosis.motion.log import Log
from app.diagnosis.motion.repeats import repeat_of
from app.diagnosis.result import Progress
from app.kinematics import RobotModel
from app.kinematics.dynamics import (
    flange_to_last_link,
    gravity_and_force_columns,
    inertial_parameters,
)
from app.kinematics.regressor import torque_regressor
from app.kinematics.robot import GRAVITY

ENOUGH = 3_000  # windows wanted before samples are averaged at all
LARGEST_POOLED = 10_000  # windows the search works on
RESOLVED = 0.02  # s: no window is longer; speed and acceleration are smoothed over more than that anyway
CHUNK = 10_000
MOST_BLOCKS = 48  # events of a twentieth of the log fill a block or two; more only makes their scan dearer
SLOW = 0.03  # share of a joint's usual speed below which the direction of its friction is open
SLOWEST = 0.008  # rad/s or m/s, likewise


@dataclass(frozen=True, eq=False)
class Samples:
    """What a fit works on: M windows of w samples, each seen at c points.

    Args:
        state: the M c points.
        window: w.
        points: c, 1 or 2.
        t: (M,) [s] from the start of the log.
        y: (M, n) torque beyond the description [Nm], averaged over each window.
        regressor: (M, 10 n, n), d torque / d inertial parameters.
        usable: (M, n) False where a joint's friction has no direction, or its torque is not measured.
        blocks: (M,) index of the block of time, rising.
        runs: slices of windows without a gap.
        centre: (M,) the log's sample in the middle of each window.
        step: time between windows [s].
        within: (n,) mean square [Nm^2] of the torque about its window's mean, the description's own change taken off.
        repeat: windows until the same trajectory runs again, 0 where it does not.
    """

    state: State
    window: int
    points: int
    t: np.ndarray
    y: np.ndarray
    regressor: np.ndarray
    usable: np.ndarray
    blocks: np.ndarray
    runs: list[slice]
    centre: np.ndarray
    step: float
    smoothing: Smoothing
    thinned: bool
    within: np.ndarray
    repeat: int

    @property
    def block_count(self) -> int:
        return int(self.blocks[-1]) + 1

    def pool(self, values: np.ndarray) -> np.ndarray:
        """Means over each window; (M c, ...) -> (M, ...)."""
        return _pooled(values, self.points)

    def with_torque(self, beyond: np.ndarray) -> Samples:
        """The same, the torque's slope in time that of the description's torque and (M, n) beyond it."""
        whole = self.pool(self.state.torque) + beyond
        rate = np.repeat(_rate(self.t, whole, self.runs), self.points, axis=0)
        return replace(self, state=replace(self.state, torque_rate=rate))


#: Smoothed position, speed and acceleration of every sample, and how they were made.
Motion = tuple[np.ndarray, np.ndarray, np.ndarray, Smoothing]


def motion_of(log: Log) -> Motion:
    """Smoothed position, speed, acceleration of every sample."""
    return differentiate(log.t, log.q, log.qd, log.segments, log.step)


def take_samples(
    log: Log,
    robot: RobotModel,
    motion: Motion,
    torque: np.ndarray,
    progress: Progress,
    *,
    shift: float = 0.0,
    gravity: np.ndarray = GRAVITY,
) -> Samples:
    """Windows, the description's columns and blocks.

    Args:
        motion: from `motion_of`.
        torque: (m, n) measured [Nm].
        gravity: (3,) [m/s^2] that is taken to act.
        shift: the torque is taken to be this much late [s]: it is compared with the motion that much earlier.
    """
    q, qd, qdd, smoothing = motion
    first, window, runs, thinned = _windows(log)
    points = 1 if window == 1 else 2
    at = _points(first, window)
    t = _between(log.t, at) - log.t[0]
    if shift:
        q, qd, qdd = (_at(log, values, t - shift) for values in (q, qd, qdd))
    else:
        q, qd, qdd = (_between(values, at) for values in (q, qd, qdd))
    n, count = robot.joint_count, len(first)
    nominal, to_last = inertial_parameters(robot), flange_to_last_link(robot)
    # Samples next to each other in memory, as the fits take them.
    regressor = np.empty((n, 10 * n, count))
    rigid, payload = np.empty((n, len(t))), np.empty((n, 10, len(t)))
    for start in range(0, len(t), CHUNK):
        progress(0.05 + 0.2 * start / len(t), "rigid-body columns")
        part = slice(start, min(start + CHUNK, len(t)))
        columns = torque_regressor(robot, q[part], qd[part], qdd[part], gravity=gravity)
        whole = np.moveaxis(columns, 0, 2)
        rigid[:, part] = nominal @ whole
        payload[:, :, part] = to_last.T @ whole[:, -10:]
        regressor[:, :, part.start // points : part.stop // points] = np.moveaxis(
            _pooled(columns, points), 0, 2
        )
    rigid, payload, regressor = rigid.T, np.moveaxis(payload, 2, 0), regressor.T
    gravity_columns, force_columns = gravity_and_force_columns(robot, q)
    middle = _pooled(t, points)
    wide = float(np.median(np.diff(middle))) if count > 1 else log.step
    state = State(
        t=t, q=q, qd=qd, qdd=qdd, torque=rigid,
        torque_rate=np.repeat(_rate(middle, _pooled(rigid, points), runs), points, axis=0),
        gravity_torque=gravity_columns @ gravity,
        gravity_columns=gravity_columns, force_columns=force_columns, payload_columns=payload,
        temperature=None if log.temperature is None else _between(log.temperature, at),
        speed=np.quantile(np.abs(qd), 0.9, axis=0), seconds=float(log.t[-1] - log.t[0]),
        sliding=np.array([joint.prismatic for joint in robot.joints]),
    )  # fmt: skip
    every = (first[:, None] + np.arange(window)).reshape(-1)
    measured = _pooled(torque[every], window)
    turning = 0.5 * (window - 1) * log.step * np.abs(_pooled(qdd, points))
    usable = _usable(state, smoothing, measured, np.abs(_pooled(qd, points)), turning, runs)
    return Samples(
        state, window, points, middle, measured - _pooled(rigid, points), regressor,
        usable, _blocks(count), runs, first + window // 2, wide, smoothing, thinned,
        _within(torque[every], rigid, window, usable),
        repeat_of(_pooled(q, points), runs),
    )  # fmt: skip


def _within(torque: np.ndarray, rigid: np.ndarray, window: int, usable: np.ndarray) -> np.ndarray:
    """(n,) mean square of the noise that averaging took away.

    Args:
        torque: (M w, n) measured.
        rigid: (M 2, n) the description's at two points of each window.
        usable: (M, n).
    """
    n = torque.shape[1]
    if window == 1:
        return np.zeros(n)
    own = torque.reshape(-1, window, n)
    own = own - own.mean(axis=1, keepdims=True)
    line = np.arange(window) - 0.5 * (window - 1)
    if window == 2:  # no noise is left beside a line through two samples: the description's own is taken
        slope = rigid[1::2] - rigid[::2]
        share = 1.0
    else:
        slope = np.einsum("k,mkn->mn", line, own) / (line @ line)
        share = (window - 1) / (window - 2)
    own = own - slope[:, None] * line[:, None]
    squares = np.mean(own**2, axis=1) * share
    return np.array([s[u].mean() if u.any() else 0.0 for s, u in zip(squares.T, usable.T, strict=True)])


def _windows(log: Log) -> tuple[np.ndarray, int, list[slice], bool]:
    """First sample of each window (M,), their length w, runs of windows, and whether windows were left out."""
    total = len(log.t)
    longest = max(1, int(RESOLVED / log.step + 1e-6))
    window = int(np.clip(total // ENOUGH, 1, longest))
    keep_every = max(1, int(np.ceil(total / window / LARGEST_POOLED)))
    starts, runs, at = [], [], 0
    for part in log.segments:
        first = np.arange(part.start, part.stop - window + 1, window * keep_every)
        if len(first) >= 8:
            starts.append(first)
            runs.append(slice(at, at + len(first)))
            at += len(first)
    return np.concatenate(starts), window, runs, keep_every > 1


def _points(first: np.ndarray, window: int) -> np.ndarray:
    """(M c,) places among the samples, not whole, that stand for each window."""
    if window == 1:
        return first.astype(float)
    spread = np.sqrt((window**2 - 1) / 12.0)  # standard deviation of the samples' places
    middle = first + 0.5 * (window - 1)
    return (middle[:, None] + spread * np.array([-1.0, 1.0])).reshape(-1)


def _between(values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Values at places between samples."""
    low = np.minimum(at.astype(int), len(values) - 2)
    share = at - low
    if not share.any():
        return values[low]
    share = share.reshape(-1, *[1] * (values.ndim - 1))
    return values[low] + share * (values[low + 1] - values[low])


def _pooled(values: np.ndarray, size: int) -> np.ndarray:
    if size == 2:
        return 0.5 * (values[::2] + values[1::2])
    return values if size == 1 else values.reshape(-1, size, *values.shape[1:]).mean(axis=1)


def _at(log: Log, values: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Values at times [s] from the log's start by local cubics through four neighbours, gaps left out of account."""
    from scipy.interpolate import CubicHermiteSpline

    slope = np.gradient(values, log.t, axis=0)
    return CubicHermiteSpline(log.t, values, slope, axis=0)(np.clip(t + log.t[0], log.t[0], log.t[-1]))


def _rate(t: np.ndarray, values: np.ndarray, runs: list[slice]) -> np.ndarray:
    out = np.empty_like(values)
    for run in runs:
        out[run] = np.gradient(values[run], t[run], axis=0)
    return out


def _usable(
    state: State,
    smoothing: Smoothing,
    measured: np.ndarray,
    speed: np.ndarray,
    turning: np.ndarray,
    runs: list[slice],
) -> np.ndarray:
    """(M, n); speed: (M, n) its size, turning: (M, n) how far it may change from a window's middle to its end."""
    out = np.ones(measured.shape, bool)
    for j in range(measured.shape[1]):
        if np.ptp(measured[:, j]) == 0:
            out[:, j] = False
        elif state.moves(j):
            noise = smoothing.noise[j] if smoothing.source == "recorded speed" else 0.0
            slow = max(SLOW * state.speed[j], min(SLOWEST, 0.15 * state.speed[j]), 3 * noise)
            open_direction = speed[:, j] < np.maximum(slow, turning[:, j])
            if open_direction.mean() < 0.85:
                out[:, j] &= ~open_direction
    edge = min(max(smoothing.half_widths), 6)
    for run in runs:
        out[run.start : run.start + edge] = out[run.stop - edge : run.stop] = False
    return out


def _blocks(count: int) -> np.ndarray:
    """(M,) block of each window: 12 to MOST_BLOCKS blocks, of 25 windows where there are so many."""
    number = int(np.clip(count // 25, 12, MOST_BLOCKS))
    return np.arange(count) * number // count
