"""Arcs out of a `tracker` recording in which one axis moved at a time.

A row belongs to the first joint that is away from where it mostly stood. Joints behind it may follow it in
proportion (controllers that couple joint 3 to joint 2), which still turns the arm as one body.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.arcs import Arc, Arcs, axis_sense, header, make_arc
from app.errors import FileFormatError
from app.kinematics import RobotModel
from app.recordings import Table
from app.units import from_deg

_STILL = from_deg(0.02)  # a joint that was not asked to move stays within this
_FEWEST = 3


@dataclass(frozen=True, eq=False)
class Recording:
    """A tracker recording's columns.

    Args:
        q: (n, joints) [rad or m] as the controller shows them.
        points: (n, k, 3) [m] of k reflectors, NaN where one was not seen.
        rows: (n,) line numbers.
    """

    q: np.ndarray
    points: np.ndarray
    rows: np.ndarray


def read_recording(table: Table) -> Recording:
    """Columns of a `tracker` table that carries points.

    Raises:
        FileFormatError: no points in it.
        MissingColumnError, CellValueError: by their place.
    """
    if table.kind != "tracker":
        raise FileFormatError(
            f"its kind is {table.kind!r}",
            file=table.path,
            column="kind",
            expected="kind: arcs or kind: tracker",
        )
    joints = table.numbered("q")
    table.require(["q1", "x", "y", "z"])
    points = [table.numbers("xyz")]
    for number in (2, 3):
        names = [f"{letter}{number}" for letter in "xyz"]
        if table.has(*names):
            points.append(table.numbers(names, missing=True))
    return Recording(table.numbers(joints), np.stack(points, axis=1), table.rows)


def rest_posture(q: np.ndarray) -> np.ndarray:
    """(joints,) where each joint mostly stood."""
    out = np.empty(q.shape[1])
    for j in range(q.shape[1]):
        values, counts = np.unique(np.round(q[:, j] / _STILL).astype(int), return_counts=True)
        near = np.abs(q[:, j] - values[np.argmax(counts)] * _STILL) <= _STILL
        out[j] = np.median(q[near, j])
    return out


def axis_of_rows(q: np.ndarray) -> np.ndarray | None:
    """(n,) which joint (from 1) each row turned, or None where joints moved together."""
    rest = rest_posture(q)
    away = np.abs(q - rest) > _STILL
    lead = np.where(away.any(axis=1), away.argmax(axis=1) + 1, 0)
    for k in range(len(lead)):  # a row at rest belongs to the arc it stands in
        if lead[k] == 0:
            lead[k] = lead[k - 1] if k and lead[k - 1] else next((a for a in lead[k:] if a), 0)
    for axis in set(lead.tolist()) - {0}:
        mine = lead == axis
        if mine.sum() < _FEWEST:
            return None
        drive = q[mine, axis - 1]
        columns = np.stack([np.ones_like(drive), drive], axis=1)
        others = np.delete(q[mine], axis - 1, axis=1)
        left = others - columns @ np.linalg.lstsq(columns, others, rcond=None)[0]
        if np.abs(left).max(initial=0.0) > _STILL:
            return None
    return lead if {1, 2} <= set(lead.tolist()) else None


def arcs_from_recording(
    table: Table, recording: Recording, lead: np.ndarray, robot: RobotModel | None
) -> Arcs:
    """One arc an axis; angles are the joints' own, turned into right-handed ones by the description."""
    rest = rest_posture(recording.q)
    arcs: dict[int, Arc] = {}
    for axis in sorted(set(lead.tolist()) - {0}):
        mine = np.flatnonzero(lead == axis)
        sense = axis_sense(table, axis)
        if robot is not None and f"axis{axis}_sense" not in table.keys:
            sense = description_sense(robot, axis, rest)
        arcs[axis] = make_arc(
            axis, recording.points[mine], sense * recording.q[mine, axis - 1], recording.rows[mine], sense
        )
    return Arcs(path=table.path, arcs=arcs, **header(table))


def description_sense(robot: RobotModel, axis: int, rest: np.ndarray) -> int:
    """+1 where the joint's positive turn is right-handed about Z (axis 1), about the arm's Y (axis 2); else +1."""
    if axis > 2 or robot.joint_count != len(rest):
        return 1
    frames = robot.chain.frames(rest[None])
    direction = frames.axes[0, axis - 1]
    if axis == 1:
        return 1 if direction[2] >= 0 else -1
    first = frames.axes[0, 0] if frames.axes[0, 0, 2] >= 0 else -frames.axes[0, 0]
    ahead = frames.flange_positions[0] - frames.joint_positions[0, 0]
    return 1 if direction @ np.cross(first, ahead) >= 0 else -1
