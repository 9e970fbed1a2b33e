"""Is this log what its header says? Time that runs backwards, degrees called radians, columns that stand still."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import median_filter

from app.diagnosis.thresholds.rows import (
    ALONE,
    FALLBACK_SPEED,
    FASTEST,
    MOST_BACKWARDS,
    MOST_SPIKES,
    SPIKE,
    SPIKE_WINDOW,
)
from app.diagnosis.wording import note
from app.errors import CellValueError, InputError, UnitError
from app.kinematics import RobotModel
from app.recordings import Table
from app.units import DEG_PER_RAD


def backwards_rows(t: np.ndarray, rows: np.ndarray, table: Table) -> np.ndarray:
    """Indices of rows whose time does not rise above all before.

    Raises:
        CellValueError: time runs backwards for more than a few rows.
    """
    highest = np.maximum.accumulate(t)
    late = np.zeros(len(t), bool)
    late[1:] = t[1:] <= highest[:-1]
    down = np.zeros(len(t), bool)
    down[1:] = np.diff(t) < 0
    # One wild time stamp must not make all that follow it look late.
    jump = np.median(np.abs(np.diff(t))) * len(t) * 5 + 1e-9
    wild = np.abs(t - median_filter(t, size=9, mode="mirror")) > jump
    if wild.any() and wild.mean() < MOST_BACKWARDS:
        rest = np.flatnonzero(~wild)
        sub = backwards_rows(t[rest], rows[rest], table)
        return np.sort(np.concatenate([np.flatnonzero(wild), rest[sub]]))
    if down.mean() > MOST_BACKWARDS or late.mean() > 0.3:
        first = int(np.flatnonzero(late)[0])
        raise CellValueError(
            f"time runs backwards (or stands still) from {t[first - 1]:.6g} to {t[first]:.6g} s "
            f"and in {int(late.sum())} of {len(t)} rows",
            file=table.path,
            row=int(rows[first]),
            column=table.columns["t"].name,
            expected="time that rises from row to row",
        )
    return np.flatnonzero(late)


def spikes(
    t: np.ndarray, q: np.ndarray, qd: np.ndarray | None, y: np.ndarray, robot: RobotModel
) -> np.ndarray:
    """Indices of rows that leave the path of their neighbours by more than an arm can move, or carry a torque that is
    none at all (a broken cell, not a loud one)."""
    step = np.median(np.diff(t))
    limit = np.where(robot.velocity > 0, robot.velocity, FALLBACK_SPEED) * FASTEST
    bad = np.zeros(len(t), bool)
    for j in range(q.shape[1]):
        for signal, least in ((q[:, j], limit[j] * step * 2 + 1e-3), (None if qd is None else qd[:, j], 1.0)):
            if signal is None:
                continue
            off = np.abs(signal - median_filter(signal, size=9, mode="mirror"))
            bad |= off > np.maximum(least, 30 * np.median(off))
        off = np.abs(y[:, j] - median_filter(y[:, j], size=9, mode="mirror"))
        spread = np.median(np.abs(y[:, j] - np.median(y[:, j])))
        bad |= off > 200 * np.median(off) + 40 * spread + 1e-9
    return np.flatnonzero(bad)


def torque_spikes(y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Single torques that stand alone, and the torques with the median of their neighbours in their place.

    A spike leaves the mean of its two neighbours by its size, and its neighbours theirs by half of it; a step leaves
    both sides alike, and a bend all around. So nothing that a model could explain is taken. Never more than
    `MOST_SPIKES` of a joint's rows: what is more frequent is how this torque is.

    Args:
        y: (m, n) [Nm].

    Returns:
        (m, n) True where set aside, (m, n) [Nm].
    """
    out, filled = np.zeros(y.shape, bool), y.copy()
    for j, column in enumerate(y.T):
        off = np.zeros(len(column))
        off[1:-1] = np.abs(column[1:-1] - 0.5 * (column[2:] + column[:-2]))
        beside = np.zeros(len(column))
        beside[1:-1] = np.maximum(off[2:], off[:-2])
        alone = (off > SPIKE * 1.4826 * np.median(off) + 1e-12) & (off > ALONE * beside)
        if 0 < alone.mean() <= MOST_SPIKES:
            out[:, j] = alone
            filled[alone, j] = median_filter(column, size=SPIKE_WINDOW, mode="mirror")[alone]
    return out, filled


def check_units(
    t: np.ndarray,
    q: np.ndarray,
    qd: np.ndarray | None,
    rows: np.ndarray,
    table: Table,
    robot: RobotModel,
    notes: list[str],
) -> np.ndarray | None:
    """Angles inside what the arm can reach, recorded speed that is the slope of the position.

    Returns:
        The recorded speed, or None where it does not belong to the positions.

    Raises:
        UnitError: angles far outside every joint limit, or speeds 57 times off.
    """
    turning = np.array([not joint.prismatic for joint in robot.joints])
    span = np.maximum(np.maximum(np.abs(robot.lower), np.abs(robot.upper)), 1.0)
    for j in np.flatnonzero(turning):
        beyond = np.abs(q[:, j]) > max(2.0 * span[j], span[j] + 2 * np.pi)
        if beyond.mean() > 0.05:
            row = int(np.flatnonzero(beyond)[0])
            column = table.columns[f"q{j + 1}"].name
            raise UnitError(
                f"{q[row, j]:.4g} rad is far outside the joint's limits "
                f"({robot.lower[j]:.3g} to {robot.upper[j]:.3g} rad); degrees marked as radians?",
                file=table.path,
                row=int(rows[row]),
                column=column,
                expected=f"q{j + 1}_deg if these are degrees",
            )
    outside = ~robot.within_limits(q, -0.02)
    if outside.any():
        where = int(np.flatnonzero(outside)[0])
        notes.append(note("samples_outside", count=int(outside.sum()), row=int(rows[where])))
    if qd is None:
        return None
    slope = np.diff(q, axis=0) / np.diff(t)[:, None]
    middle = 0.5 * (qd[1:] + qd[:-1])
    even = np.diff(t) < 3 * np.median(np.diff(t))
    for j in range(q.shape[1]):
        a, b = slope[even, j], middle[even, j]
        if np.std(a) < 1e-4 or np.std(b) < 1e-6:
            if np.std(a) > 0.02:
                notes.append(note("speed_still", joint=j + 1))
                return None
            if np.ptp(q[:, j]) == 0.0 and np.std(b) > 0.02:
                raise CellValueError(
                    f"the position of joint {j + 1} is the same in every row while its recorded speed changes",
                    file=table.path,
                    row=int(rows[0]),
                    column=table.columns[f"q{j + 1}"].name,
                    expected="positions that follow the speed",
                )
            continue
        ratio = float(np.sqrt(np.sum(b**2) / np.sum(a**2)))
        alike = float(np.sum(a * b) / np.sqrt(np.sum(a**2) * np.sum(b**2)))
        if alike > 0.7 and (abs(np.log(ratio / DEG_PER_RAD)) < 0.2 or abs(np.log(ratio * DEG_PER_RAD)) < 0.2):
            raise UnitError(
                f"the recorded speed of joint {j + 1} is {ratio:.3g} times the slope of its position; "
                "degrees marked as radians?",
                file=table.path,
                row=table.header_row,
                column=table.columns[f"qd{j + 1}"].name,
                expected="position and speed in the units their names say",
            )
        if alike < 0.5 or not 0.7 < ratio < 1.5:
            if np.sqrt(np.mean(a**2)) < 0.01:
                continue  # hardly moves: rounding decides
            notes.append(note("speed_no_slope", joint=j + 1, ratio=ratio, alike=alike))
            return None
    return qd


def check_moves(q: np.ndarray, y: np.ndarray, table: Table, notes: list[str]) -> None:
    """Something moves and something is measured.

    Raises:
        InputError: no joint moves, or no torque changes.
    """
    moving, changing = np.ptp(q, axis=0) > 1e-3, np.ptp(y, axis=0) > 0
    if not moving.any():
        raise InputError(
            "no joint moves in this log",
            file=table.path,
            column="q1",
            expected="a motion of 0.001 rad or more",
        )
    if not changing.any():
        raise InputError(
            "no torque changes in this log",
            file=table.path,
            column="tau1_Nm",
            expected="measured torques or currents",
        )
    still, dead = np.flatnonzero(~moving) + 1, np.flatnonzero(~changing) + 1
    for found, one, many in ((still, "joint_still", "joints_still"), (dead, "torque_dead", "torques_dead")):
        if len(found):
            notes.append(note(one if len(found) == 1 else many, joints=tuple(found.tolist())))
