"""Files -> result, as the command and the pendant ask for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from app.calibration.base import report, report_arm, report_poses
from app.calibration.base.arcs import Arcs, read_arcs
from app.calibration.base.naming import arcs_from_names
from app.calibration.base.poserelation import PoseRelation, pose_warnings, relate_poses
from app.calibration.base.poses import PoseBase, base_from_poses
from app.calibration.base.relation import Relation, relate
from app.calibration.base.result import BaseCalibration
from app.calibration.base.sequence import (
    Recording,
    arcs_from_recording,
    axis_of_rows,
    read_recording,
    rest_posture,
)
from app.calibration.base.sixaxis import ArmGeometry, arm_geometry
from app.calibration.base.solve import solve_base
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.errors import DegenerateGeometryError, InputError, MissingColumnError
from app.kinematics import RobotModel
from app.phrases import FALLBACK
from app.recordings import Table, read_table
from app.recordings.arm import names_robot, robot_for
from app.recordings.options import ReadOptions
from app.recordings.point_lists import KIND
from app.units import from_mm


@dataclass(frozen=True, eq=False)
class ArcResult:
    """One robot's arcs, or two robots' with their relation; the arm's geometry where more axes were turned."""

    bases: tuple[BaseCalibration, ...]
    arms: tuple[ArmGeometry | None, ...]
    relation: Relation | None
    models: tuple[RobotModel | None, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """teachframe.base/1."""
        out = report.base_json(self.bases, self.relation)
        for details, arm in zip(out["robots"], self.arms, strict=True):
            details["arm"] = None if arm is None else report_arm.arm_json(arm)
        return _with_flanges(out, self.models)

    def to_text(self, language: str = FALLBACK) -> str:
        """A page for a person."""
        parts = []
        for base, arm in zip(self.bases, self.arms, strict=True):
            parts.append(report.base_text(base, language))
            if arm is not None:
                parts.append(report_arm.arm_text(arm, language))
        parts += report_arm.flange_lines(self.models, language)
        return "\n".join(parts + ([report.relation_text(self.relation, language)] if self.relation else []))


@dataclass(frozen=True, eq=False)
class PoseResult:
    """Bases from poses."""

    files: tuple[Path, ...]
    robots: tuple[str, ...]
    bases: tuple[PoseBase, ...]
    warnings: tuple[Warning_, ...]
    relation: PoseRelation | None
    rows: tuple[np.ndarray, ...]
    models: tuple[RobotModel, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """teachframe.base/1 without arcs."""
        out = report_poses.poses_json(
            self.files, self.robots, self.bases, self.warnings, self.relation, self.rows
        )
        return _with_flanges(out, self.models)

    def to_text(self, language: str = FALLBACK) -> str:
        """A page for a person."""
        page = report_poses.poses_text(
            self.files, self.robots, self.bases, self.warnings, self.relation, language
        )
        return "\n".join([page, *report_arm.flange_lines(self.models, language)])


def _with_flanges(out: dict[str, Any], models: Sequence[RobotModel | None]) -> dict[str, Any]:
    """The object with the link that was taken as each arm's flange."""
    for details, model in zip(out["robots"], models, strict=True):
        details["flange"] = None if model is None else model.flange
    return out


def run_base(
    files: Sequence[Path],
    *,
    robot: str | None = None,
    patterns: Sequence[str] = (),
    meeting_mm: Sequence[float] | None = None,
    unit: str | None = None,
    joints: Path | None = None,
) -> ArcResult | PoseResult:
    """Reads one or two files and finds the base(s).

    Args:
        files: one or two.
        robot: description by name or path; None takes what each file says.
        patterns: AXIS=PATTERN for exports whose point names do not say the axis.
        meeting_mm: where both tools meet, in base 1 [mm].
        unit: `mm`, `m` or `in`, for exports that do not say theirs.
        joints: joint angles of the same poses, for lists of tracked points.

    Raises:
        InputError, DegenerateGeometryError: as the readers and the solver say, naming the file.
    """
    if meeting_mm is not None and not np.isfinite(meeting_mm).all():
        raise InputError(f"found {tuple(meeting_mm)}", column="--at", expected="three finite numbers [mm]")
    options = ReadOptions(unit=unit, joints=joints)
    tables = [read_table(path, options) for path in files]
    recordings = [read_recording(t) if t.kind == "tracker" else None for t in tables]
    leads = [None if r is None else axis_of_rows(r.q) for r in recordings]
    if any(r is not None and lead is None for r, lead in zip(recordings, leads, strict=True)):
        return _from_poses(tables, recordings, robot)
    bases, arms, models = [], [], []
    for table, recording, lead in zip(tables, recordings, leads, strict=True):
        base, arm, model = _from_arcs(table, recording, lead, robot, patterns)
        bases.append(base)
        models.append(model)
        arms.append(arm)
    meeting = None if meeting_mm is None else from_mm(np.array(meeting_mm, float))
    relation = relate(bases[0], bases[1], meeting) if len(bases) == 2 else None
    return ArcResult(tuple(bases), tuple(arms), relation, tuple(models))


def _from_arcs(
    table: Table,
    recording: Recording | None,
    lead: np.ndarray | None,
    robot: str | None,
    patterns: Sequence[str],
) -> tuple[BaseCalibration, ArmGeometry | None, RobotModel | None]:
    model, trouble = description(table, robot)
    if recording is not None and lead is not None:
        arcs = arcs_from_recording(table, recording, lead, model)
        rest = rest_posture(recording.q)
    else:
        arcs = arcs_from_names(table, patterns) if table.kind == KIND else read_arcs(table)
        rest = None if model is None else np.zeros(model.joint_count)
    try:
        base = solve_base(arcs, model)
        arm = _arm(arcs, base, model, rest)
    except DegenerateGeometryError as error:
        raise error.in_file(table.path) from None
    if trouble is not None:
        base = replace(base, warnings=(*base.warnings, trouble))
    return base, arm, model


def _arm(
    arcs: Arcs, base: BaseCalibration, model: RobotModel | None, rest: np.ndarray | None
) -> ArmGeometry | None:
    """Where axis 3 (and on) was turned as well, without a gap."""
    row = [found for k, found in enumerate(base.arcs) if found.arc.axis == k + 1]
    return arm_geometry(row, model, rest) if len(row) > 2 and len(row) == len(arcs.arcs) else None


def description(table: Table, asked: str | None) -> tuple[RobotModel | None, Warning_ | None]:
    """The robot's description; one that a file names and that is not there is worth a warning, not a refusal."""
    if not names_robot(table, asked):
        return None, None
    if asked is not None:
        return robot_for(table, asked), None
    try:
        return robot_for(table), None
    except InputError as error:
        return None, remark("robot", error=error)


def _from_poses(
    tables: Sequence[Table], recordings: Sequence[Recording | None], asked: str | None
) -> PoseResult:
    bases, models, warnings, lines = [], [], [], []
    for table, recording in zip(tables, recordings, strict=True):
        if recording is None:
            raise InputError(
                "holds arcs, but the other file holds poses",
                file=table.path,
                expected="two files of one kind",
            )
        if not names_robot(table, asked):
            raise MissingColumnError(
                "several axes moved at a time, so the robot's description is needed",
                file=table.path,
                column="robot",
                expected="a '# robot:' line or --robot",
            )
        model = robot_for(table, asked)
        if model.joint_count != recording.q.shape[1]:
            raise MissingColumnError(
                f"{recording.q.shape[1]} joint columns",
                file=table.path,
                row=table.header_row,
                column="q",
                expected=f"{model.joint_count}, as {model.name} has",
            )
        frames = model.chain.frames(recording.q)
        try:
            base = base_from_poses(frames.flange_rotations, frames.flange_positions, recording.points[:, 0])
        except DegenerateGeometryError as error:
            raise error.in_file(table.path) from None
        bases.append(base)
        models.append(model)
        warnings += pose_warnings(base, recording.rows)
        lines.append(recording.rows)
    relation = None
    if len(bases) == 2:
        still = [float(np.mean(r.q[:, 0])) for r in recordings if r is not None]
        relation = relate_poses(bases[0], bases[1], (models[0], models[1]), (still[0], still[1]))
    return PoseResult(
        tuple(t.path for t in tables),
        tuple(m.name for m in models),
        tuple(bases),
        tuple(warnings),
        relation,
        tuple(lines),
        tuple(models),
    )
