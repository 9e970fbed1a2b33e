"""A recording and its robot: found by what was asked for, else by the header."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from app.errors import FileFormatError, MissingColumnError
from app.kinematics import RobotModel, load_robot
from app.kinematics.description.address import Address, address_of, parse_address
from app.kinematics.named import robot_of_file
from app.recordings.adjusting import with_effort, without_whole_turns
from app.recordings.options import ReadOptions
from app.recordings.reading import read_table
from app.recordings.table import Table
from app.recordings.torques import check_torques

#: Header keys beside `robot` that choose a part of it.
_CHOICES = ("flange", "chain", "calibration")


def read_with_arm(
    path: str | Path,
    robot: str | None = None,
    options: ReadOptions | None = None,
    *,
    check: Callable[[Table], object] = lambda _: None,
) -> tuple[Table, RobotModel]:
    """A recording and its robot. Where the robot is named from outside, its joints are looked for by name.

    Args:
        path: the recording.
        robot: an address (see kinematics/description/address.py); None takes the header's.
        options: how to read files that do not say everything themselves.
        check: looks at the recording before its robot is looked for, and raises where it is none of its own.

    Raises:
        InputError: as the readers say.
    """
    options = options or ReadOptions()
    asked = None if robot is None else parse_address(robot)
    arm = load_robot(robot) if robot is not None and asked is not None and asked.place else None
    if arm is not None:
        names, slides = zip(*((joint.name, joint.prismatic) for joint in arm.joints), strict=True)
        options = replace(options, joint_names=names, slides=slides)
    table = with_effort(read_table(path, options), options)
    check(table)
    arm = robot_for(table, robot) if arm is None else arm
    if table.kind == "motion":
        table = without_whole_turns(table, arm)
        if options.effort is None:
            check_torques(table, arm)
    return table, arm


def robot_for(table: Table, named: str | None = None) -> RobotModel:
    """The robot named on the command line, else by the recording's header (a path is relative to the file).

    Args:
        table: the recording.
        named: an address; one without a place (`#flange=tool0`) chooses a part of the header's robot.

    Raises:
        InputError: neither names one, or it cannot be loaded.
    """
    asked = Address("") if named is None else parse_address(named)
    if asked.place:
        return load_robot(str(asked))
    stated = _stated(table, "robot")
    if stated is None:
        raise MissingColumnError(
            "no robot is named",
            file=table.path,
            row=1,
            column="robot",
            expected="--robot NAME|FILE.urdf, or a line '# robot: NAME or path relative to the file'",
        )
    chosen = {key: _stated(table, key) for key in _CHOICES}
    address = address_of(stated, **chosen)
    whole = parse_address(str(address)).but(
        asked.flange, "..".join(asked.chain) if asked.chain else None, asked.calibration
    )
    return robot_of_file(str(whole), table.path)


def names_robot(table: Table, named: str | None = None) -> bool:
    """True where the command line or the header says whose recording this is."""
    return table.keys.get("robot") is not None or (named is not None and bool(parse_address(named).place))


def _stated(table: Table, key: str) -> str | None:
    value = table.keys.get(key)
    if value is None:
        return None
    if not isinstance(value, str):
        raise FileFormatError(
            f"found {str(value)[:40]!r}",
            file=table.path,
            column=key,
            expected="a robot's name or the path of a URDF" if key == "robot" else "text",
        )
    return value


def described(robot: RobotModel) -> str:
    """The arm and its flange in a few words, for outputs: `ur10e, 6 joints, flange tool0`."""
    base = f", base {robot.base}" if robot.base else ""
    joints = f"{robot.joint_count} joint{'s' if robot.joint_count != 1 else ''}"
    return f"{robot.name}, {joints}{base}, flange {robot.flange}"
