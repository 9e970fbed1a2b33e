"""Position, speed and acceleration of every sample; the window is the one under which the torques are explained best.

A window that minimises the risk of the acceleration alone is one candidate. Others, wider and narrower, with the
recorded speed or without it, are held against the measured torques: the description's regressor and the friction of
each joint are fitted to some hundred samples under each, and the least residual wins.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.filters import HALF_WIDTHS, Run, Smoothing, differentiate, noise_of
from app.kinematics import RobotModel
from app.kinematics.regressor import PER_LINK, torque_regressor
from app.steps import done

if TYPE_CHECKING:
    from app.diagnosis.observations.joint_log import Log


PROBED = 6_000  # samples the choice looks at
COMPARED = 700  # of them the torques are explained for
BETTER = 0.02  # nepers of the mean residual by which a window must beat the one of least risk
WORSE = 0.15  # beyond the best so far, wider windows are not tried
LONGEST = 0.6  # s, of a window
_CHOOSING, _PART_LEFT = 0.8, 0.85  # share of the work that the choice is; what each window leaves of it


@dataclass(frozen=True, eq=False)
class Motion:
    """Smoothed position, speed and acceleration of every sample, (m, n) each.

    Args:
        smoothing: what was used.
        speed_noise: (n,) noise left on the speed [rad/s].
    """

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    smoothing: Smoothing
    speed_noise: np.ndarray


def motion_of(log: Log, robot: RobotModel) -> Motion:
    """Smooths a log."""
    choice = _choice(log, robot)
    return _smoothed(log, choice)


def _smoothed(log: Log, choice: tuple[bool, int | None]) -> Motion:
    recorded, half = choice
    qd = log.qd if recorded else None
    q, speed, push, smoothing = differentiate(log.t, log.q, qd, log.segments, log.step, half)
    return Motion(q, speed, push, smoothing, _speed_noise(smoothing))


def _speed_noise(smoothing: Smoothing) -> np.ndarray:
    """One-sigma noise of the smoothed speed: the filter's share of the signal's."""
    from app.diagnosis.models.dynamic.filters import _weights

    derivative = 0 if smoothing.source == "recorded speed" else 1
    out = []
    for half, noise in zip(smoothing.half_widths, smoothing.noise, strict=True):
        weights = _weights(half, derivative)[half] / smoothing.step**derivative
        out.append(noise * float(np.linalg.norm(weights)))
    return np.array(out)


def _choice(log: Log, robot: RobotModel) -> tuple[bool, int | None]:
    """Whether the recorded speed is used, and the half width for all joints (None: least risk, joint by joint)."""
    part = _probe(log)
    rows = np.unique(np.linspace(2, len(part.t) - 3, COMPARED).astype(int))
    best: tuple[float, tuple[bool, int | None]] | None = None
    rest = 1.0  # how many windows are tried nobody knows before: each takes its part of what is left
    for recorded in (True, False):
        if recorded and log.qd is None:
            continue
        run = Run(part.t, part.q, part.qd if recorded else None, part.step)
        windows, least = run.windows(), np.inf
        for half in (None, *HALF_WIDTHS[1:]):
            if (half is not None and (2 * half + 1) * log.step > LONGEST) or (half or 0) * 8 > len(part.t):
                break
            smoothing = windows.smoothing(part.step, half)
            motion = Motion(*run.motion(windows, half), smoothing, _speed_noise(smoothing))
            rest *= _PART_LEFT
            done(_CHOOSING * (1.0 - rest))
            score = _unexplained(motion, part.y, robot, rows) + (0.0 if half is None else BETTER)
            if best is None or score < best[0]:
                best = (score, (recorded, half))
            if half is not None and score > least + WORSE:
                break
            least = min(least, score)
    assert best is not None
    return best[1]


def _probe(log: Log) -> Log:
    """The longest run of the log, cut to what the choice looks at."""
    from dataclasses import replace

    run = max(log.segments, key=lambda s: s.stop - s.start)
    part = slice(run.start, min(run.stop, run.start + PROBED))
    return replace(
        log, t=log.t[part], q=log.q[part], qd=None if log.qd is None else log.qd[part], y=log.y[part],
        segments=[slice(0, part.stop - part.start)],
    )  # fmt: skip


def _unexplained(motion: Motion, y: np.ndarray, robot: RobotModel, rows: np.ndarray) -> float:
    """Mean over the joints of the logarithm of the torque left by rigid body and friction, loud rows clipped."""
    q, qd, qdd = motion.q[rows], motion.qd[rows], motion.qdd[rows]
    regressor = torque_regressor(robot, q, qd, qdd)
    total, n = 0.0, q.shape[1]
    for j in range(n):
        width = max(2e-3, float(motion.speed_noise[j]))
        own = np.stack([np.tanh(qd[:, j] / width), qd[:, j], qdd[:, j], np.ones(len(rows))], axis=1)
        columns = np.hstack([regressor[:, j, PER_LINK * j :], own])
        size = np.sqrt(np.mean(columns**2, axis=0))
        columns = columns[:, size > 1e-12] / size[size > 1e-12]
        gram = columns.T @ columns
        gram[np.diag_indices_from(gram)] += 1e-6 * len(rows)
        left = y[rows, j] - columns @ np.linalg.solve(gram, columns.T @ y[rows, j])
        low, high = np.percentile(left, [1, 99])
        total += float(np.log(np.sqrt(np.mean(np.clip(left, low, high) ** 2)) + 1e-12))
    return total / n


__all__ = ["Motion", "motion_of", "noise_of"]
