"""What speaks against a static recording before anything is searched: another unit, another arm.

A search explains what it is given. These checks ask whether it was given what the columns say.
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.kinematic.plain import plain_state
from app.diagnosis.observations.noise import residual_rms
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.observations.pose_reading import read_static
from app.diagnosis.thresholds.conventions import FALL, GROSS, JOINT_HARDLY
from app.errors import InputError, TeachframeError
from app.kinematics import RobotModel, load_robot, robot_names
from app.recordings import Table
from app.units import DEG_PER_RAD, mm


def check_arm(table: Table, robot: RobotModel) -> None:
    """A recording that has nothing to do with the described arm, and all with a shipped one.

    Raises:
        InputError: names the arm that it fits.
    """
    own = _left(read_static(table, robot))
    if own < GROSS:
        return
    name, left = _better(table, robot, own)
    if name:
        raise InputError(
            f"base and tool leave {mm(own):.3g} mm with {robot.name} and {mm(left):.3g} mm with {name}: a recording of "
            "another arm",
            file=table.path,
            expected=f"--robot {name}",
        )


def check_units(table: Table, robot: RobotModel) -> None:
    """One joint written in another unit than its column says.

    Raises:
        InputError: the recording fits far better with the column taken in the other unit.
    """
    q = table.numbers([f"q{j + 1}" for j in range(robot.joint_count)])
    span = np.ptp(q, axis=0)
    outside = np.any((q > robot.upper + 1e-3) | (q < robot.lower - 1e-3), axis=0)
    suspects = [
        (j, DEG_PER_RAD if 0.0 < span[j] < JOINT_HARDLY else 1.0 / DEG_PER_RAD)
        for j, joint in enumerate(robot.joints)
        if not joint.prismatic and (0.0 < span[j] < JOINT_HARDLY or outside[j])
    ]
    if not suspects or len(suspects) == robot.joint_count:  # all at once is a convention, and named as one
        return
    recording = read_static(table, robot)
    usual = _left(recording)
    for j, factor in suspects:
        scaled = recording.q.copy()
        scaled[:, j] *= factor
        left = _left(recording.with_joints(robot, scaled))
        if left < FALL * usual:
            column = table.columns[f"q{j + 1}"]
            other = "radians" if factor > 1.0 else "degrees"
            raise InputError(
                f"its values look like {other}: the recording then fits to "
                f"{mm(left):.3g} mm, and to {mm(usual):.3g} mm as it is",
                file=table.path,
                row=table.header_row,
                column=column.name,
                expected="values of the unit in the column's name",
            )


def _better(table: Table, robot: RobotModel, own: float) -> tuple[str, float]:
    """The shipped arm that the recording fits far better than the `own` [m], and what is left with it; "" for none."""
    best, name = FALL * FALL * own, ""
    for other in robot_names():
        arm = load_robot(other)
        same = [j.prismatic for j in arm.joints] == [j.prismatic for j in robot.joints]
        if other == robot.name or not same:
            continue
        try:
            left = _left(read_static(table, arm))
        except TeachframeError:
            continue
        if left < best:
            best, name = left, other
    return name, best


def _left(recording: StaticRecording) -> float:
    """What base and tool leave [m]."""
    state, rows = plain_state(recording, (), quick=True)
    return residual_rms(state, rows > 0)
