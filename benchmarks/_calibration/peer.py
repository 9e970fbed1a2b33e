"""The ordinary calibration of one arm, from the files to its errors here and on another run."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from benchmarks._calibration.chain import Chain
from benchmarks._calibration.fit import (
    ELASTIC,
    GEOMETRY,
    NOTHING,
    Errors,
    Fit,
    errors,
    fullest,
    near,
    residual,
    rms,
    solve,
)
from benchmarks._calibration.readings import Readings, read, robot_of

#: By this factor the error of base and tool has to fall before joint 3 is believed to count against the horizon.
MUCH = 10.0


@dataclass(frozen=True, eq=False)
class Calibrated:
    """An arm calibrated on some recordings.

    Args:
        chain: the arm as described.
        horizon: what of joint 2 is added to joint 3: 0, or 1 or -1 where the controller counts joint 3 against the
            horizon, as a user who knows the arm would say.
        rows: how many there are.
        aside: (S,) lines set aside, by file.
        here: errors by what was fitted.
        arms: the fits, by what was fitted.
        seconds: processor time of all three fits with their folds.
    """

    chain: Chain
    horizon: int
    rows: int
    aside: tuple[tuple[int, ...], ...]
    here: dict[str, Errors]
    arms: dict[str, Fit]
    seconds: float


def calibrate(paths: Sequence[Path]) -> Calibrated:
    """Base and tool; full geometry; elasticity too where torques are known."""
    start = time.process_time()
    chain, readings, horizon = _understood(paths)
    keep = near(chain, readings)
    kept = readings.part(keep)
    stages = [NOTHING, GEOMETRY] + ([ELASTIC] if fullest(readings) == ELASTIC else [])
    return Calibrated(
        chain,
        horizon,
        len(keep),
        tuple(
            tuple(int(r) for r in readings.rows[~keep & (readings.session == s)]) for s in range(len(paths))
        ),
        {what: errors(chain, kept, what) for what in stages},
        {what: solve(chain, kept, what) for what in stages},
        time.process_time() - start,
    )


def carried(learnt: Calibrated, path: Path) -> tuple[dict[str, Errors], tuple[int, ...]]:
    """Errors on another run with the arm as learnt, base and tool fitted there; lines of that run set aside.

    The rows set aside are those that the run's own full fit finds far off.
    """
    readings = _against(read([path], robot_of(path)), learnt.horizon)
    keep = near(learnt.chain, readings)
    kept = readings.part(keep)
    there = {what: errors(learnt.chain, kept, NOTHING, arm) for what, arm in learnt.arms.items()}
    return there, tuple(int(r) for r in readings.rows[~keep])


def _understood(paths: Sequence[Path]) -> tuple[Chain, Readings, int]:
    """The arm and what was measured, joint 3 against joint 2 or, where that is far better, against the horizon."""
    robot = robot_of(paths[0])
    chain, readings = Chain(robot), read(paths, robot)
    if chain.n < 3 or (readings.target >= 0).all():
        return chain, readings, 0

    def left(turned: int) -> float:
        there = _against(readings, turned)
        return rms(residual(chain, there, solve(chain, there, NOTHING))[0])

    plain = left(0)
    best = min((1, -1), key=left)
    horizon = best if MUCH * left(best) < plain else 0
    return chain, _against(readings, horizon), horizon


def _against(readings: Readings, horizon: int) -> Readings:
    if not horizon:
        return readings
    q = readings.q.copy()
    q[:, 2] += horizon * q[:, 1]
    return replace(readings, q=np.ascontiguousarray(q))
