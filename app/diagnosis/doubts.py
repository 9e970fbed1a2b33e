"""What speaks against a static recording, or against the names found in it: another unit, another arm, too few rows.

A search explains what it is given. These checks ask whether it was given what the columns say.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.result import Diagnosis, Leftover
from app.diagnosis.static.noise import position_rms
from app.diagnosis.static.plain import plain_fit
from app.diagnosis.static.reading import read_static
from app.diagnosis.static.recording import StaticRecording
from app.diagnosis.wording import note
from app.errors import InputError, TeachframeError
from app.kinematics import RobotModel, load_robot, robot_names
from app.recordings import Table
from app.units import DEG_PER_RAD, deg, from_deg, from_mm, mm

#: A joint that moves by less than this, in radians, may have been written in radians under a name in degrees.
_HARDLY = 4.0 * np.pi / DEG_PER_RAD
#: What base and tool leave must fall to this share before another unit is believed.
_FALL = 1.0 / 3.0
#: What no fault of an arm leaves: beyond it the recording is of another arm, or written down wrongly.
_GROSS = from_mm(20.0)
#: With fewer rows than this a law can be mistaken for its neighbour.
FEWEST_NAMED = 15
#: A link that is off by more belongs to another arm: no gauge, belt or bolt does that.
_ANOTHER_LENGTH, _ANOTHER_TWIST = from_mm(20.0), from_deg(3.0)
#: Held-out error beyond which, and so many times the fitted one, a model predicts nothing.
_FAR, _TIMES = 5.0, 10.0  # mm


def check_arm(table: Table, robot: RobotModel) -> None:
    """A recording that has nothing to do with the described arm, and all with a shipped one.

    Raises:
        InputError: names the arm that it fits.
    """
    own = _left(read_static(table, robot))
    if own < _GROSS:
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
        (j, DEG_PER_RAD if 0.0 < span[j] < _HARDLY else 1.0 / DEG_PER_RAD)
        for j, joint in enumerate(robot.joints)
        if not joint.prismatic and (0.0 < span[j] < _HARDLY or outside[j])
    ]
    if not suspects or len(suspects) == robot.joint_count:  # all at once is a convention, and named as one
        return
    recording = read_static(table, robot)
    usual = _left(recording)
    for j, factor in suspects:
        scaled = recording.q.copy()
        scaled[:, j] *= factor
        left = _left(recording.with_joints(robot, scaled))
        if left < _FALL * usual:
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


def doubted(found: Diagnosis, robot: RobotModel) -> Diagnosis:
    """The diagnosis, its names withheld where they cannot be believed."""
    if not found.findings:
        return found
    why = _another_arm(found, robot) or _predicts_nothing(found)
    if not why and found.samples < FEWEST_NAMED:
        why = note("few_rows", count=found.samples, fewest=FEWEST_NAMED)
    if not why:
        return found
    where = {k: v for k, v in found.findings[0].where.items() if k in ("joint", "link", "body", "driver")}
    return replace(
        found,
        verdict="unexplained",
        findings=(),
        leftover=Leftover(min(found.leftover.p_value, 0.01), where),
        next_poses=(),
        model={},
        notes=(*found.notes, why),
    )


def _another_arm(found: Diagnosis, robot: RobotModel) -> str:
    """Why this is a recording of another arm; empty where nothing says so."""
    far = [
        (f, p)
        for f in found.findings
        for p in f.parameters
        if (f.effect == "link_length" and abs(_si(p)) > _ANOTHER_LENGTH)
        or (f.effect == "link_twist" and abs(_si(p)) > _ANOTHER_TWIST)
    ]
    if not far:
        return ""
    finding, parameter = far[0]
    long, off = finding.effect == "link_length", abs(_si(parameter))
    return note(
        "another_arm_length" if long else "another_arm_twist",
        link=finding.where.get("link"),
        off=mm(off) if long else deg(off),
        robot=robot.name,
    )


def _better(table: Table, robot: RobotModel, own: float) -> tuple[str, float]:
    """The shipped arm that the recording fits far better than the `own` [m], and what is left with it; "" for none."""
    best, name = _FALL * _FALL * own, ""
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


def _predicts_nothing(found: Diagnosis) -> str:
    fit, heldout = found.after.fit_rms, found.after.heldout_rms
    if heldout > _FAR and heldout > _TIMES * fit:
        return note("predicts_nothing", fit=fit, heldout=heldout)
    return ""


def _left(recording: StaticRecording) -> float:
    """What base and tool leave [m]."""
    return position_rms(plain_fit(recording, (), quick=True))


def _si(parameter) -> float:
    """The value in SI: findings give theirs in the unit beside them."""
    return {"mm": from_mm, "deg": from_deg}.get(parameter.unit, float)(parameter.value)
