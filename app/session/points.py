"""Points as the calibration reads them: from a file as one action, and from what was recorded."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from app.calibration.captures import ROLES, Capture, split_role
from app.calibration.points import Points, Written, disagreement, read_points
from app.calibration.tool import ORIENTATIONS, allowed_orientation
from app.errors import InputError, UnknownNameError
from app.geometry import AngleConvention, Pose, convention
from app.kinematics import RobotModel, robot_names
from app.session.actions import LoadPoints
from app.session.state import MODES, SessionState, as_tuple, mode_named, robot_named

#: A quaternion's length may differ from 1 by this, as in a points file.
_QUATERNION = 0.02


def load_action(path: Path, *, method: str = "joint", mode: str | None = None) -> LoadPoints:
    """A points file as an action that holds all of it.

    Args:
        path: the file.
        method: estimator of the tool point.
        mode: key of the wizard mode; None takes the one that asks for these roles.

    Raises:
        InputError: the file cannot be used, or no mode asks for these roles.
    """
    points = read_points(path)
    written = points.written
    both = points.disagreement is not None and points.robot is not None and points.robot.name in robot_names()
    return LoadPoints(
        source=points.path.name,
        title=points.title,
        mode=mode or _mode_of(points),
        method=method,
        roles=tuple(capture.role for capture in points.captures),
        rows=tuple(capture.row for capture in points.captures),
        columns=written.names,
        values=tuple(tuple(float(v) for v in row) for row in written.values),
        steps=tuple(float(v) for v in written.steps),
        angles=written.convention.key if written.convention else "",
        robot=points.robot.name if points.robot and (both or not written.convention) else "",
        references={name: (float(p[0]), float(p[1]), float(p[2])) for name, p in points.references.items()},
        note=points.note,
        joints=tuple(as_tuple(c.q) for c in points.captures if c.q is not None) if both else (),
    )


def _mode_of(points: Points) -> str:
    """The touch mode whose orientation the roles allow."""
    from app import catalog

    wanted = allowed_orientation(points.captures)
    for key, mode in catalog.members(MODES, "MODE").items():
        if getattr(mode, "orientation", None) == wanted and getattr(mode, "shared_origin", False):
            return key
    raise InputError(
        f"no wizard mode asks for the roles {', '.join(sorted({c.role for c in points.captures}))}",
        file=points.path,
        column="role",
        expected="touch, touch+origin, x, z",
    )


def loaded_points(action: LoadPoints) -> Points:
    """The points of a loaded file, as the calibration would have read them.

    Raises:
        InputError: an unknown convention, robot or role; columns that are not those of the convention or the robot.
    """
    form = convention(action.angles) if action.angles else None
    robot = robot_named(action.robot) if action.robot else None
    _check_columns(action, form, robot)
    poses = _poses_by_angles(form) if form is not None else _poses_by_joints(robot)
    values = np.array(action.values, float)
    matrices = poses(values)
    joints = None if robot is None else np.array(action.joints or action.values, float)
    captures = tuple(
        Capture(f"row{row}", role, Pose(matrix), None if joints is None else joints[i], row)
        for i, (role, row, matrix) in enumerate(zip(action.roles, action.rows, matrices, strict=True))
    )
    apart = None
    if robot is not None and action.joints:
        apart = disagreement(matrices, _poses_by_joints(robot)(np.array(action.joints, float)))
    written = Written(action.columns, values, np.array(action.steps), poses, form)
    references = {name: np.array(point) for name, point in action.references.items()}
    return Points(Path(action.source), action.title, captures, written, references, apart, robot, action.note)


def _check_columns(action: LoadPoints, form: AngleConvention | None, robot: RobotModel | None) -> None:
    """Raises InputError unless the columns are those the numbers are read by."""
    bare = [name.rpartition("_")[0] or name for name in action.columns]
    wanted = ["x", "y", "z", *form.columns] if form is not None else []
    if robot is not None and form is None:
        wanted = [f"q{j}" for j in range(1, robot.joint_count + 1)]
    if bare != wanted and list(action.columns) != wanted:
        raise InputError(
            f"columns {', '.join(action.columns)[:80]}", column="columns", expected=", ".join(wanted)
        )
    unknown = {role for roles in action.roles for role in split_role(roles)} - set(ROLES)
    if unknown:
        raise UnknownNameError(min(unknown)[:40], available=ROLES, what="role")
    if robot is not None and any(len(q) != robot.joint_count for q in action.joints):
        raise InputError(
            "joint positions of another arm", column="joints", expected=f"{robot.joint_count} each"
        )
    if form is not None and not form.angular:
        lengths = np.linalg.norm(np.array(action.values, float)[:, 3:], axis=1)
        if np.abs(lengths - 1.0).max() > _QUATERNION:
            raise InputError("a quaternion's length is not 1", column="values", expected="length 1")


def recorded_points(state: SessionState) -> Points:
    """The points of the wizard's rows: a loaded file's own where nothing was recorded since, else joint positions."""
    if state.source is not None:
        return loaded_points(state.source)
    captures = state.ordered
    robot = state.model
    values = np.array([c.q for c in captures if c.q is not None])
    names = tuple(f"q{j + 1}_{'m' if joint.prismatic else 'rad'}" for j, joint in enumerate(robot.joints))
    written = Written(names, values, np.zeros(len(names)), _poses_by_joints(robot), None)
    title = f"{mode_named(state.mode).title}, {robot.title}"
    return Points(Path("session"), title, captures, written, {}, None, robot)


def orientation_of(mode: str) -> str | None:
    """The orientation a touch mode teaches; None for modes that solve in their own way."""
    wanted = getattr(mode_named(mode), "orientation", None)
    return wanted if wanted in ORIENTATIONS else None


def _poses_by_angles(form: AngleConvention) -> Callable[[np.ndarray], np.ndarray]:
    def poses(numbers: np.ndarray) -> np.ndarray:
        out = np.tile(np.eye(4), (len(numbers), 1, 1))
        out[:, :3, :3] = form.to_rotation(numbers[:, 3:])
        out[:, :3, 3] = numbers[:, :3]
        return out

    return poses


def _poses_by_joints(robot: RobotModel | None) -> Callable[[np.ndarray], np.ndarray]:
    if robot is None:
        raise InputError("points without poses and without a robot", expected="one of them")

    def poses(numbers: np.ndarray) -> np.ndarray:
        frames = robot.chain.frames(numbers)
        out = np.tile(np.eye(4), (len(numbers), 1, 1))
        out[:, :3, :3], out[:, :3, 3] = frames.flange_rotations, frames.flange_positions
        return out

    return poses
