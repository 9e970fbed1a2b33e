"""Does a recording belong to its robot? As many joints, of the same kinds, and numbers that an arm can have."""

from __future__ import annotations

import re

import numpy as np

from app.errors import CellValueError, InputError, UnitError
from app.kinematics import RobotModel
from app.recordings.table import Table

#: The largest believable value by SI unit: joint angles, lengths, times (clocks count from 1970), torques, loads.
_LARGEST = {"rad": 100.0, "m": 1000.0, "s": 1e11, "Nm": 1e7, "kg": 1e5, "degC": 1e4}
_SI = {"mm": "m", "deg": "rad", "ms": "s", "us": "s", "ns": "s", "iso": "s"}


def check_joints(table: Table, robot: RobotModel) -> None:
    """As many joint columns as the robot has joints, turning ones in angles and sliding ones in lengths.

    Raises:
        MissingColumnError, InputError, UnitError: they do not belong together.
    """
    n = robot.joint_count
    table.require(f"q{j}" for j in range(1, n + 1))
    beyond = sorted(
        (name for name in table.columns if re.fullmatch(r"q\d+", name) and not 1 <= int(name[1:]) <= n),
        key=lambda name: int(name[1:]),
    )
    if beyond:
        raise InputError(
            f"robot {robot.name} has {n} joints",
            file=table.path,
            row=table.header_row,
            column=table.columns[beyond[0]].name,
            expected=f"columns q1 to q{n}, or another --robot",
        )
    for number, joint in enumerate(robot.joints, 1):
        column = table.columns[f"q{number}"]
        slides = column.unit in ("m", "mm")
        if slides != joint.prismatic:
            raise UnitError(
                f"joint {number} of {robot.name} {'slides' if joint.prismatic else 'turns'}",
                file=table.path,
                row=table.header_row,
                column=column.name,
                expected=f"q{number}_m" if joint.prismatic else f"q{number}_rad or q{number}_deg",
            )


def check_sizes(table: Table) -> None:
    """Angles within a hundred radians, lengths within a kilometre: beyond, a cell is broken or has another unit.

    Raises:
        CellValueError: the first cell beyond.
    """
    for name, column in table.columns.items():
        unit = _SI.get(column.unit or "", column.unit or "")
        if not column.known or unit not in _LARGEST:
            continue
        beyond = np.flatnonzero(np.abs(table.number(name, missing=True)) > _LARGEST[unit])
        if len(beyond):
            first = int(beyond[0])
            raise CellValueError(
                f"found {table.raw(name)[first]}",
                file=table.path,
                row=int(table.rows[first]),
                column=column.name,
                expected=f"a value of at most {_LARGEST[unit]:g} {unit}",
            )
