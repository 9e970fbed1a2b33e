"""Points files: what a wizard would have recorded, read from a table.

A row holds a role and either joint positions (with `# robot`) or the flange pose (with `# angles`). Where both stand
there, the pose is used and compared with the joints.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.calibration.captures import ROLES, Capture, split_role
from app.errors import CellValueError, FileFormatError, MissingColumnError, UnitError, UnknownNameError
from app.geometry import CONVENTIONS, AngleConvention, Pose, angle_between
from app.kinematics import RobotModel
from app.recordings import Table, read_table
from app.recordings.arm import names_robot, robot_for

#: Joints and pose of one row that differ by more than this do not belong together.
POSITION_TOLERANCE, ANGLE_TOLERANCE = 1e-3, 2e-3
_QUATERNION_TOLERANCE = 0.02
#: Beyond these a number is a mistake, not a unit that was mixed up [m, rad].
_FARTHEST, _MOST_TURNED = 1e5, 1e4


@dataclass(frozen=True, eq=False)
class Written:
    """The numbers as they stand in the file, and how they make flange poses.

    Args:
        names: (k) column names.
        values: (n, k) in SI units.
        steps: (k,) step of the last digit written, SI units; 0 where written in full.
        poses: (m, k) -> (m, 4, 4) T_base_flange.
        convention: the angle convention, or None where joints were written.
    """

    names: tuple[str, ...]
    values: np.ndarray
    steps: np.ndarray
    poses: Callable[[np.ndarray], np.ndarray]
    convention: AngleConvention | None


@dataclass(frozen=True, eq=False)
class Points:
    """One points file.

    Args:
        path: the file.
        title: the header's title, or "".
        captures: one a row, in order.
        written: what the poses were made from.
        references: tool points [m] that the header states, by their key without `_mm`.
        disagreement: (n, 2) distance [m] and angle [rad] between joints and pose; None where only one stands there.
        robot: the arm, where the file names one.
        note: the header's note, or "".
    """

    path: Path
    title: str
    captures: tuple[Capture, ...]
    written: Written
    references: dict[str, np.ndarray]
    disagreement: np.ndarray | None
    robot: RobotModel | None
    note: str = ""


def read_points(path: str | Path, robot: str | None = None) -> Points:
    """Reads a points file.

    Args:
        path: the file.
        robot: the arm's address, for joints; None takes the header's.

    Raises:
        InputError: names the file, the row and the column.
    """
    return points_from_table(read_table(path), robot)


def points_from_table(table: Table, robot: str | None = None) -> Points:
    """The same from a table that has been read."""
    if table.kind not in (None, "points"):
        raise FileFormatError(
            f"its kind is {table.kind!r}", file=table.path, column="# kind", expected="points"
        )
    table.require(["role"])
    by_pose, by_joints = _written_pose(table), _written_joints(table, robot)
    arm = None
    apart = None
    joints = None
    if by_joints is not None:
        joints, arm = by_joints
    if by_pose is None:
        if joints is None:
            table.require(["x", "y", "z"])
            raise MissingColumnError(
                "no flange orientation and no joints",
                file=table.path,
                row=table.header_row,
                column="a_deg",
                expected="a_deg, b_deg, c_deg or qw, qx, qy, qz or q1_deg, q2_deg, …",
            )
        by_pose = joints
    elif joints is not None:
        apart = disagreement(by_pose.poses(by_pose.values), joints.poses(joints.values))
    roles = _roles(table)
    matrices = by_pose.poses(by_pose.values)
    q = None if joints is None else joints.values
    captures = tuple(
        Capture(f"row{row}", role, Pose(matrix), None if q is None else q[i], int(row))
        for i, (role, matrix, row) in enumerate(zip(roles, matrices, table.rows, strict=True))
    )
    title = table.keys.get("title")
    if isinstance(title, dict):  # YAML reads a colon inside the title as another key
        title = ": ".join(str(part) for pair in title.items() for part in pair)
    note = str(table.keys.get("note") or "")
    stated = _references(table)
    return Points(table.path, str(title or ""), captures, by_pose, stated, apart, arm, note)


def _roles(table: Table) -> list[str]:
    roles = [role.lower() for role in table.text("role")]
    for role, row in zip(roles, table.rows, strict=True):
        for part in split_role(role):
            if part not in ROLES:
                raise CellValueError(
                    f"found {part[:40]!r}" if part else "the cell is empty",
                    file=table.path,
                    row=int(row),
                    column="role",
                    expected="one of " + ", ".join(ROLES) + ", or two joined by +",
                )
    return roles


def _written_pose(table: Table) -> Written | None:
    form = _convention(table)
    if form is None:
        return None
    names = ["x", "y", "z", *form.columns]
    values = _within(table, names, 3)
    if not form.angular:
        norms = np.linalg.norm(values[:, 3:], axis=1)
        bad = np.flatnonzero(np.abs(norms - 1.0) > _QUATERNION_TOLERANCE)
        if len(bad):
            raise CellValueError(
                f"the quaternion has length {norms[bad[0]]:.4g}",
                file=table.path,
                row=int(table.rows[bad[0]]),
                column="qw",
                expected="length 1",
            )

    def poses(numbers: np.ndarray) -> np.ndarray:
        out = np.tile(np.eye(4), (len(numbers), 1, 1))
        out[:, :3, :3] = form.to_rotation(numbers[:, 3:])
        out[:, :3, 3] = numbers[:, :3]
        return out

    return Written(_named(table, names), values, _steps(table, names), poses, form)


def _convention(table: Table) -> AngleConvention | None:
    stated = table.keys.get("angles")
    if stated is not None:
        key = next((k for k in CONVENTIONS if k.lower() == str(stated).strip().lower()), None)
        if key is None:
            raise UnknownNameError(
                str(stated)[:40],
                available=CONVENTIONS,
                what="angle convention",
                file=table.path,
                column="# angles",
            )
        return CONVENTIONS[key]
    if table.has("qw"):
        return CONVENTIONS["quaternion"]
    if table.has("a"):
        raise MissingColumnError(
            "angles without their convention",
            file=table.path,
            column="# angles",
            expected="one of " + ", ".join(CONVENTIONS),
        )
    return None


def _written_joints(table: Table, named: str | None) -> tuple[Written, RobotModel] | None:
    names = table.numbered("q")
    if not names:
        return None
    if not names_robot(table, named):
        if table.has("x", "y", "z"):
            return None
        raise MissingColumnError(
            "joint angles without their robot",
            file=table.path,
            column="# robot",
            expected="a robot's name or the path of a URDF",
        )
    robot = robot_for(table, named)
    table.require([f"q{j + 1}" for j in range(robot.joint_count)])
    if len(names) != robot.joint_count:
        raise FileFormatError(
            f"{len(names)} joint columns",
            file=table.path,
            row=table.header_row,
            column=names[-1],
            expected=f"{robot.joint_count} for {robot.title} from {robot.base} to its flange {robot.flange}",
        )
    for name, joint in zip(names, robot.joints, strict=True):
        column = table.columns[name]
        if (column.unit in ("m", "mm")) != joint.prismatic:
            raise UnitError(
                f"joint {joint.name!r} {'slides' if joint.prismatic else 'turns'}",
                file=table.path,
                row=table.header_row,
                column=column.name,
                expected=f"{name}_m or {name}_mm" if joint.prismatic else f"{name}_deg or {name}_rad",
            )

    def poses(numbers: np.ndarray) -> np.ndarray:
        frames = robot.chain.frames(numbers)
        out = np.tile(np.eye(4), (len(numbers), 1, 1))
        out[:, :3, :3] = frames.flange_rotations
        out[:, :3, 3] = frames.flange_positions
        return out

    return Written(_named(table, names), _within(table, names, 0), _steps(table, names), poses, None), robot


def _within(table: Table, names: list[str], lengths: int) -> np.ndarray:
    """(n, k) the columns in SI units, the first `lengths` of them lengths; refused where no flange can be."""
    values = table.numbers(names)
    largest = np.where(np.arange(len(names)) < lengths, _FARTHEST, _MOST_TURNED)
    wrong = np.argwhere(np.abs(values) > largest)
    if len(wrong):
        row, column = wrong[0]
        raise CellValueError(
            f"found {(table.raw(names[column])[row] or '')[:40]!r}",
            file=table.path,
            row=int(table.rows[row]),
            column=table.columns[names[column]].name,
            expected="a position within 100 km" if column < lengths else "an angle of a few turns at most",
        )
    return values


def _named(table: Table, names: list[str]) -> tuple[str, ...]:
    return tuple(table.columns[name].name for name in names)


def _steps(table: Table, names: list[str]) -> np.ndarray:
    return np.array([table.resolution(name) for name in names])


def disagreement(poses: np.ndarray, others: np.ndarray) -> np.ndarray:
    """(n, 2) distance [m] and angle [rad] between two batches of flange poses (n, 4, 4)."""
    distance = np.linalg.norm(poses[:, :3, 3] - others[:, :3, 3], axis=1)
    return np.stack([distance, angle_between(poses[:, :3, :3], others[:, :3, :3])], axis=1)


def _references(table: Table) -> dict[str, np.ndarray]:
    """Header keys `…tool_mm: [x, y, z]` or `…tool_m: […]`."""
    from app.units import SI_FACTORS

    found = {}
    for key, value in table.keys.items():
        name, _, unit = key.rpartition("_")
        if not name.endswith("tool") or unit not in ("mm", "m"):
            continue
        try:
            point = np.array(value, float)
        except (TypeError, ValueError):
            point = np.zeros(0)
        if point.shape != (3,) or not np.isfinite(point).all():
            raise CellValueError(
                f"found {str(value)[:40]!r}", file=table.path, column=f"# {key}", expected="[x, y, z]"
            )
        found[name] = point * SI_FACTORS[unit]
    return found
