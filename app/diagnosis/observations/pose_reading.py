"""From a table to a static recording: what can be used, and what a person should know of the rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.models.kinematic.in_motion import speeds
from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.observations.measured import distinct, length_resolution, touched, tracked, useless
from app.diagnosis.observations.pose_data import StaticRecording, cut
from app.diagnosis.observations.sensed import sensed_torques
from app.diagnosis.observations.suspicion import joint_notes, refuse_joints, refuse_measurements
from app.diagnosis.observations.thinning import thinned
from app.diagnosis.thresholds.rows import LEAST_ROWS
from app.diagnosis.wording import note
from app.errors import InputError, TooFewPointsError
from app.kinematics import RobotModel
from app.recordings import Table
from app.steps import done, part
from app.units import from_deg, from_mm


def read_static(table: Table, robot: RobotModel) -> StaticRecording:
    """Reads a touch or tracker table.

    Raises:
        InputError: columns that do not fit the robot, or that cannot be a measurement.
        TooFewPointsError: fewer rows than the unknowns need.
    """
    key = ("static", robot)
    if key not in table.kept:  # checks of the recording ask before the diagnosis does
        table.kept[key] = _read(table, robot)
    return table.kept[key]


def _read(table: Table, robot: RobotModel) -> StaticRecording:
    with part(0.0, 0.2):  # with the rows of the file, where nobody has asked for a column yet
        q, q_rows = _joints(table, robot)
    notes: list[str] = []
    measured = touched(table, notes) if table.kind == "touch" else tracked(table, notes)
    refuse_joints(table, robot, q)
    refuse_measurements(table, measured.points, measured.lengths)
    notes += joint_notes(robot, q)
    m = len(q)
    session = _numbers(table, "session", m)
    time = _optional(table, "t")
    if time is not None and np.any(np.diff(time) < 0):
        notes.append(note("backwards"))
    done(0.3)
    pose = _poses(table, q, session)
    done(0.45)
    digits = length_resolution(table, measured)
    done(0.55)
    keep = distinct(q, measured, time, digits, notes)
    done(0.7)
    for mask, text in useless(measured, session):
        if (mask & keep).any():
            notes.append(note(text, count=int((mask & keep).sum())))
            keep &= ~mask
    usable, keep = int(keep.sum()), thinned(keep, pose, measured.target, session)
    if keep.sum() < usable:
        notes.append(note("rows_chosen", count=int(keep.sum()), total=usable))
    torque = sensed_torques(table, robot, q, notes)
    done(0.8)
    recording = StaticRecording(
        file=str(table.path),
        kind=str(table.kind),
        mode=measured.mode,
        rows=q_rows[keep],
        points=cut(measured.points, keep),
        orientations=cut(measured.orientations, keep),
        lengths=cut(measured.lengths, keep),
        target=(np.zeros(m, int) if measured.target is None else measured.target)[keep],
        target_names=measured.names,
        session=session[keep],
        pose=pose[keep],
        situation=situation_for(
            robot,
            q,
            sessions=session,
            torque=torque,
            payload=_optional(table, "payload"),
            payload_com=_vector(table, "payload_com_m", 3),
            declared_compliance=_vector(table, "compliance_rad_per_Nm", robot.joint_count),
            time=time,
            speed=None if time is None else speeds(time, q, session),
            temperature=_temperature(table),
            keep=keep,
            instrument=measured.mode,
            reflectors=1 if measured.points is None else measured.points.shape[1],
        ),
        stated_noise=_stated_noise(table),
        angle_resolution=_angle_resolution(table, robot),
        length_resolution=digits,
        notes=tuple(notes),
    )
    recording = renumbered(recording)
    unknowns = (
        6 + 3 * recording.reflectors if measured.mode != "targets" else 3 + 3 * len(recording.target_names)
    )
    if recording.size < LEAST_ROWS or recording.present.sum() <= unknowns:
        raise TooFewPointsError(
            f"{recording.size} usable rows cannot settle {unknowns} unknowns (base, tool, targets)",
            needed=LEAST_ROWS,
            advice="record more poses",
            file=table.path,
        )
    return recording


def renumbered(recording: StaticRecording) -> StaticRecording:
    """The same rows with sessions, poses and targets numbered without gaps."""
    session = np.unique(recording.session, return_inverse=True)[1]
    pose = np.unique(recording.pose, return_inverse=True)[1]
    target, names = recording.target, recording.target_names
    if names:
        used, target = np.unique(target, return_inverse=True)
        names = tuple(names[i] for i in used)
    return replace(recording, session=session, pose=pose, target=target, target_names=names)


def _joints(table: Table, robot: RobotModel) -> tuple[np.ndarray, np.ndarray]:
    names = table.numbered("q")
    n = robot.joint_count
    if len(names) < n:
        table.require([f"q{len(names) + 1}"])
    if len(names) > n:
        raise InputError(
            f"{len(names)} joints are recorded, {robot.name} has {n}",
            file=table.path,
            row=table.header_row,
            column=table.columns[names[n]].name,
            expected=f"q1 … q{n}, or another --robot",
        )
    for j, name in enumerate(names):
        unit = table.columns[name].unit
        sliding = robot.joints[j].prismatic
        if (unit in ("m", "mm")) != sliding:
            raise InputError(
                f"joint {j + 1} of {robot.name} {'slides' if sliding else 'turns'}",
                file=table.path,
                row=table.header_row,
                column=table.columns[name].name,
                expected=f"{name}_{'m' if sliding else 'rad'}",
            )
    return table.numbers(names), table.rows


def _numbers(table: Table, quantity: str, m: int) -> np.ndarray:
    """Texts as numbers in the order of their first appearance."""
    if not table.has(quantity):
        return np.zeros(m, int)
    seen: dict[str, int] = {}
    return np.array([seen.setdefault(text, len(seen)) for text in table.text(quantity)], int)


def _optional(table: Table, quantity: str) -> np.ndarray | None:
    return table.number(quantity) if table.has(quantity) else None


def _poses(table: Table, q: np.ndarray, session: np.ndarray) -> np.ndarray:
    """One number a pose: said by the file, else rows of the same angles."""
    if table.has("pose"):
        return _numbers(table, "pose", len(q))
    return np.unique(np.column_stack([q, session]), axis=0, return_inverse=True)[1].reshape(-1)


def _temperature(table: Table) -> np.ndarray | None:
    names = [name for name in ("temperature", *table.numbered("temperature")) if table.has(name)]
    return np.mean(table.numbers(names), axis=1) if names else None


def _vector(table: Table, key: str, size: int) -> np.ndarray | None:
    if table.keys.get(key) is None:
        return None
    try:
        value = np.array(table.keys[key], float).reshape(-1)
    except (TypeError, ValueError):
        value = np.zeros(0)
    if len(value) != size or not np.isfinite(value).all():
        raise InputError("not a list of numbers", file=table.path, column=key, expected=f"{size} numbers")
    return value


def _stated_noise(table: Table) -> float | None:
    value = table.keys.get("noise_mm")
    if value is None:
        return None
    try:
        noise = float(np.sqrt(np.mean(np.square(np.array(value, float)))))
    except (TypeError, ValueError):
        noise = float("nan")
    if not noise > 0:
        raise InputError(
            f"found {value!r}"[:60], file=table.path, column="noise_mm", expected="a positive number"
        )
    return float(from_mm(noise))


def _angle_resolution(table: Table, robot: RobotModel) -> float:
    stated = table.keys.get("resolution_deg")
    if stated is not None:
        try:
            return float(from_deg(float(stated)))
        except (TypeError, ValueError):
            raise InputError(
                f"found {stated!r}"[:60], file=table.path, column="resolution_deg", expected="a number"
            ) from None
    turning = [f"q{j + 1}" for j, joint in enumerate(robot.joints) if not joint.prismatic]
    return max((table.resolution(name) for name in turning), default=0.0)
