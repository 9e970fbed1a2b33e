"""From a log to the samples a fit works on: smoothed motion, the description's columns, windows, blocks.

A long log is pooled: torque and every column are averaged over short windows, which keeps what is linear
exactly linear; beyond LARGEST_USED samples the windows are taken evenly over the whole log.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.effects.motion._state import State
from app.diagnosis.motion.filters import Smoothing, differentiate
from app.diagnosis.motion.log import Log
from app.diagnosis.result import Progress
from app.kinematics import RobotModel
from app.kinematics.dynamics import (
    flange_to_last_link,
    gravity_and_force_columns,
    inertial_parameters,
    torque_regressor,
)
from app.kinematics.robot import GRAVITY

LARGEST_POOLED = 20_000  # windows the search works on
LARGEST_USED = 100_000  # samples it looks into
CHUNK = 10_000
SLOW = 0.03  # share of a joint's usual speed below which the direction of its friction is open
SLOWEST = 0.008  # rad/s or m/s, likewise


@dataclass(frozen=True, eq=False)
class Samples:
    """What a fit works on: M windows of w samples.

    Args:
        state: the M w samples.
        window: w.
        t: (M,) [s] from the start of the log.
        y: (M, n) torque beyond the description [Nm], averaged over each window.
        regressor: (M, 10 n, n), d torque / d inertial parameters.
        usable: (M, n) False where a joint's friction has no direction, or its torque is not measured.
        blocks: (M,) index of the block of time, rising.
        runs: slices of windows without a gap.
        index: (M w,) which of the log's samples.
        step: time between windows [s].
    """

    state: State
    window: int
    t: np.ndarray
    y: np.ndarray
    regressor: np.ndarray
    usable: np.ndarray
    blocks: np.ndarray
    runs: list[slice]
    index: np.ndarray
    step: float
    smoothing: Smoothing
    thinned: bool

    @property
    def block_count(self) -> int:
        return int(self.blocks[-1]) + 1

    def pool(self, values: np.ndarray) -> np.ndarray:
        """Averages per-sample values over each window; (M w, ...) -> (M, ...)."""
        if self.window == 1:
            return values
        return values.reshape(-1, self.window, *values.shape[1:]).mean(axis=1)


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
    index, window, runs, thinned = _windows(log)
    t = log.t[index] - log.t[0]
    if shift:
        q, qd, qdd = (_earlier(log, values, index, shift) for values in (q, qd, qdd))
    else:
        q, qd, qdd = q[index], qd[index], qdd[index]
    n, count = robot.joint_count, len(index) // window
    speed = np.quantile(np.abs(qd), 0.9, axis=0)
    nominal, to_last = inertial_parameters(robot), flange_to_last_link(robot)
    regressor = np.empty((count, 10 * n, n))
    rigid = np.empty((len(index), n))
    gravity_columns, force_columns = np.empty((len(index), n, 3)), np.empty((len(index), n, 3))
    payload = np.empty((len(index), n, 10))
    size = CHUNK // window * window
    for start in range(0, len(index), size):
        progress(0.05 + 0.2 * start / len(index), "rigid-body columns")
        part = slice(start, min(start + size, len(index)))
        columns = torque_regressor(robot, q[part], qd[part], qdd[part], gravity=gravity)
        rigid[part] = columns @ nominal
        payload[part] = columns[:, :, -10:] @ to_last
        pooled = columns if window == 1 else columns.reshape(-1, window, n, 10 * n).mean(axis=1)
        regressor[part.start // window : part.stop // window] = np.swapaxes(pooled, 1, 2)
        gravity_columns[part], force_columns[part] = gravity_and_force_columns(robot, q[part])
    state = State(
        t=t, q=q, qd=qd, qdd=qdd, torque=rigid,
        torque_rate=_rate(t, rigid, window, runs),
        gravity_torque=gravity_columns @ gravity,
        gravity_columns=gravity_columns, force_columns=force_columns, payload_columns=payload,
        temperature=None if log.temperature is None else log.temperature[index],
        speed=speed, seconds=float(log.t[-1] - log.t[0]),
        sliding=np.array([joint.prismatic for joint in robot.joints]),
    )  # fmt: skip
    pool = _pooler(window)
    measured = torque[index]
    wide = float(np.median(np.diff(pool(t)))) if count > 1 else log.step
    return Samples(
        state, window, pool(t), pool(measured - rigid), regressor,
        _usable(state, smoothing, measured, pool, runs), _blocks(count), runs, index, wide, smoothing, thinned,
    )  # fmt: skip


def _windows(log: Log) -> tuple[np.ndarray, int, list[slice], bool]:
    """Sample indices (M w,), w, runs of windows, and whether windows were left out."""
    total = len(log.t)
    window = max(1, int(np.ceil(min(total, LARGEST_USED) / LARGEST_POOLED)))
    starts, runs, at = [], [], 0
    keep_every = max(1, int(np.ceil(total / LARGEST_USED)))
    for part in log.segments:
        first = np.arange(part.start, part.stop - window + 1, window * keep_every)
        if len(first) >= 8:
            starts.append(first)
            runs.append(slice(at, at + len(first)))
            at += len(first)
    first = np.concatenate(starts)
    return (first[:, None] + np.arange(window)).reshape(-1), window, runs, keep_every > 1


def _earlier(log: Log, values: np.ndarray, index: np.ndarray, shift: float) -> np.ndarray:
    """Values at t - shift by local cubics through four neighbours, gaps left out of account."""
    from scipy.interpolate import CubicHermiteSpline

    slope = np.gradient(values, log.t, axis=0)
    return CubicHermiteSpline(log.t, values, slope, axis=0)(
        np.clip(log.t[index] - shift, log.t[0], log.t[-1])
    )


def _rate(t: np.ndarray, values: np.ndarray, window: int, runs: list[slice]) -> np.ndarray:
    if window > 1:
        v, s = values.reshape(-1, window, values.shape[1]), t.reshape(-1, window)
        slope = (v[:, -1] - v[:, 0]) / np.maximum(s[:, -1] - s[:, 0], 1e-12)[:, None]
        return np.repeat(slope, window, axis=0)
    out = np.empty_like(values)
    for run in runs:
        out[run] = np.gradient(values[run], t[run], axis=0)
    return out


def _pooler(window: int):
    def pool(values: np.ndarray) -> np.ndarray:
        return values if window == 1 else values.reshape(-1, window, *values.shape[1:]).mean(axis=1)

    return pool


def _usable(state: State, smoothing: Smoothing, measured: np.ndarray, pool, runs: list[slice]) -> np.ndarray:
    count, n = len(pool(state.t)), state.joints
    out = np.ones((count, n), bool)
    slowest = np.abs(pool(state.qd))
    for j in range(n):
        if np.ptp(measured[:, j]) == 0:
            out[:, j] = False
        elif state.moves(j):
            noise = smoothing.noise[j] if smoothing.source == "recorded speed" else 0.0
            slow = slowest[:, j] < max(SLOW * state.speed[j], min(SLOWEST, 0.15 * state.speed[j]), 3 * noise)
            if slow.mean() < 0.85:
                out[:, j] &= ~slow
    edge = min(max(smoothing.half_widths), 6)
    for run in runs:
        out[run.start : run.start + edge] = out[run.stop - edge : run.stop] = False
    return out


def _blocks(count: int) -> np.ndarray:
    """(M,) block of each window: 24 to 80 blocks of 25 windows or more."""
    number = int(np.clip(count // 25, 12, 80))
    return np.arange(count) * number // count
