"""Recorded numbers that cannot be what their columns say."""

from __future__ import annotations

import numpy as np

from app.diagnosis.thresholds.conventions import FARTHEST, WAY_OUT
from app.diagnosis.wording import note
from app.errors import CellValueError, InputError
from app.kinematics import RobotModel
from app.recordings import Table
from app.units import DEG_PER_RAD, deg


def refuse_joints(table: Table, robot: RobotModel, q: np.ndarray) -> None:
    """Angles that can only be of another unit.

    Raises:
        CellValueError: names the first such cell.
    """
    for j, joint in enumerate(robot.joints):
        beyond = np.maximum(q[:, j] - joint.upper, joint.lower - q[:, j])
        worst = int(np.argmax(beyond))
        limit = FARTHEST if joint.prismatic else WAY_OUT
        if beyond[worst] > limit:
            column = table.columns[f"q{j + 1}"]
            raise CellValueError(
                f"{q[worst, j] / column.factor:.6g} is far outside joint {j + 1}'s limits"
                + (" (degrees in a radian column?)" if column.unit == "rad" else ""),
                file=table.path,
                row=int(table.rows[worst]),
                column=column.name,
                expected="values of the unit in the column's name",
            )
    if not np.ptp(q, axis=0).any():
        raise InputError(
            "no joint moves", file=table.path, column=table.columns["q1"].name, expected="different poses"
        )


def joint_notes(robot: RobotModel, q: np.ndarray) -> list[str]:
    """Warnings about the recorded joints."""
    notes = []
    still = [j + 1 for j in range(q.shape[1]) if np.ptp(q[:, j]) == 0.0]
    if still:
        notes.append(note("still", joints=tuple(still)))
    outside = ~robot.within_limits(q, margin=-1e-3)
    if outside.any():
        notes.append(note("outside", count=int(outside.sum())))
    turning = [j for j, joint in enumerate(robot.joints) if not joint.prismatic]
    span = np.ptp(q[:, turning], axis=0).max(initial=0.0)
    if 0.0 < span * DEG_PER_RAD < 2.0 * np.pi and span < 0.1:
        notes.append(note("hardly", span=deg(span)))
    return notes


def refuse_measurements(table: Table, points: np.ndarray | None, lengths: np.ndarray | None) -> None:
    """Measurements that never change, or lie where nothing measures.

    Raises:
        CellValueError, InputError: naming the column.
    """
    values: dict[str, np.ndarray] = {}
    if lengths is not None:
        values["length"] = lengths
    if points is not None and table.has("x"):
        for r in range(points.shape[1]):
            for c in range(3):
                values["xyz"[c] + ("" if r == 0 else str(r + 1))] = points[:, r, c]
    for name, column in values.items():
        seen = column[np.isfinite(column)]
        label = table.columns[name].name
        if len(seen) == 0:
            raise InputError("every cell is empty", file=table.path, column=label, expected="measurements")
        if len(seen) > 3 and np.ptp(seen) == 0.0 and seen[0] == 0.0:
            raise InputError("every value is 0", file=table.path, column=label, expected="measurements")
        far = np.flatnonzero(np.abs(np.nan_to_num(column)) > FARTHEST)
        if len(far):
            raise CellValueError(
                f"{column[far[0]] / table.columns[name].factor:.6g} is farther than any instrument sees",
                file=table.path,
                row=int(table.rows[far[0]]),
                column=label,
                expected="values of the unit in the column's name",
            )
