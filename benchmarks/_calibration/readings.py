"""Touches and tracker recordings of one arm as arrays; several files are sessions with base and tool of their own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.errors import InputError
from app.kinematics import RobotModel, load_robot
from app.recordings import Table, read_table

#: Rows whose joints agree to this are one pose [rad or m]: an encoder's noise while an arm stands is far below it.
SAME_POSE = 1e-3


@dataclass(frozen=True, eq=False)
class Readings:
    """What was measured.

    Args:
        q: (m, n) joint positions [rad or m].
        points: (m, P, 3) measured [m], NaN where a cell is empty; zero for touches of unknown points.
        session: (m,) file of each row.
        target: (m,) number of the touched point, -1 for measured ones.
        torque: (m, n) measured or, from the description's masses, gravity torque [Nm]; None where neither is known.
        pose: (m,) rows of one number repeat one pose.
        rows: (m,) line in the file.
    """

    q: np.ndarray
    points: np.ndarray
    session: np.ndarray
    target: np.ndarray
    torque: np.ndarray | None
    pose: np.ndarray
    rows: np.ndarray

    def part(self, keep: np.ndarray) -> Readings:
        """Some of the rows; `keep` (m,) bool."""
        torque = None if self.torque is None else self.torque[keep]
        return Readings(
            self.q[keep],
            self.points[keep],
            self.session[keep],
            self.target[keep],
            torque,
            self.pose[keep],
            self.rows[keep],
        )


def robot_of(path: Path) -> RobotModel:
    """The arm that a recording's header names."""
    return load_robot(str(read_table(path).keys["robot"]), relative_to=path.parent)


def read(paths: Sequence[Path], robot: RobotModel) -> Readings:
    """Reads the files as one recording with a session each.

    Raises:
        InputError: a file holds neither measured points nor touches.
    """
    parts = [_one(read_table(path), robot, number) for number, path in enumerate(paths)]
    count = 0
    for k, part in enumerate(parts):
        touched = part.target >= 0
        parts[k] = Readings(
            part.q,
            part.points,
            part.session,
            np.where(touched, part.target + count, -1),
            part.torque,
            part.pose,
            part.rows,
        )
        count += int(part.target.max(initial=-1)) + 1
    torques = [p.torque for p in parts if p.torque is not None]
    q = np.concatenate([p.q for p in parts])
    return Readings(
        q,
        np.concatenate([p.points for p in parts]),
        np.concatenate([p.session for p in parts]),
        np.concatenate([p.target for p in parts]),
        np.concatenate(torques) if len(torques) == len(parts) else None,
        np.unique(np.round(q / SAME_POSE), axis=0, return_inverse=True)[1].reshape(-1),
        np.concatenate([p.rows for p in parts]),
    )


def _one(table: Table, robot: RobotModel, number: int) -> Readings:
    q = table.numbers([f"q{j}" for j in range(1, robot.joint_count + 1)])
    m = len(q)
    target = np.full(m, -1)
    if table.has("x"):
        names = [
            [f"{axis}{p}" for axis in "xyz"] for p in ("", 2, 3) if table.has(*(f"{a}{p}" for a in "xyz"))
        ]
        points = np.stack([table.numbers(three, missing=True) for three in names], axis=1)
    elif table.has("target"):
        points = np.zeros((m, 1, 3))
        target = np.unique(table.text("target"), return_inverse=True)[1]
    else:
        raise InputError(
            "it holds no measured points", file=table.path, expected="columns x_mm, y_mm, z_mm or target"
        )
    return Readings(
        q, points, np.full(m, number), target, _torque(table, robot, q), np.zeros(m, int), table.rows
    )


def _torque(table: Table, robot: RobotModel, q: np.ndarray) -> np.ndarray | None:
    """Measured joint torques where the file has them; else gravity's, where the description has masses."""
    if table.has("tau1"):
        return table.numbers([f"tau{j}" for j in range(1, robot.joint_count + 1)])
    return robot.gravity_torques(q) if robot.has_inertials else None
