"""One recording to one diagnosis: finds the robot, checks that the two belong together, picks the engine."""

from __future__ import annotations

import importlib
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.result import Diagnosis, Progress
from app.diagnosis.wording import kind_name, note
from app.errors import (
    CellValueError,
    FileFormatError,
    InputError,
    MissingColumnError,
    UnitError,
    UnknownNameError,
)
from app.kinematics import RobotModel, load_robot
from app.recordings import Table, read_table
from app.recordings.joining import joined

#: Kind of recording -> the package whose `diagnose` reads it. Imported when needed.
ENGINES = {
    "touch": "app.diagnosis.static",
    "tracker": "app.diagnosis.static",
    "motion": "app.diagnosis.motion",
}
#: The largest believable value by SI unit: joint angles, lengths, times (clocks count from 1970), torques, loads.
_LARGEST = {"rad": 100.0, "m": 1000.0, "s": 1e11, "Nm": 1e7, "kg": 1e5, "degC": 1e4}
#: Kinds that other commands read.
ELSEWHERE = {"points": "teachframe solve", "arcs": "teachframe base"}


def diagnose_file(
    path: str | Path,
    *,
    robot: str | None = None,
    reference: str | Path | None = None,
    model: SavedModel | None = None,
    progress: Progress | None = None,
    seed: int = 0,
) -> Diagnosis:
    """Diagnoses one recording.

    Args:
        path: the recording.
        robot: a shipped robot's name or a URDF's path; None takes the header's `# robot:`.
        reference: a motion recording of the same arm in a known good state.
        model: effects found before, taken as part of the robot.

    Raises:
        InputError: what was given cannot be used; names file, row and column.
        Cancelled: `progress` stopped it.
    """
    table = read_table(path)
    kind, _ = kind_of(table)
    arm = robot_for(table, robot)
    extra = {} if reference is None else {"reference": _reference(reference, kind, path, arm)}
    return _diagnosed(table, arm, model, progress, seed, extra)


def diagnose_together(
    paths: Sequence[str | Path],
    *,
    robot: str | None = None,
    model: SavedModel | None = None,
    progress: Progress | None = None,
    seed: int = 0,
) -> Diagnosis:
    """Diagnoses several touch or tracker recordings of one arm as one: what they share is the arm.

    Raises:
        InputError: one of them cannot be used, or they do not belong together.
        Cancelled: `progress` stopped it.
    """
    tables = [read_table(path) for path in paths]
    kinds = [kind_of(table)[0] for table in tables]
    arms = [robot_for(table, robot) for table in tables]
    for table, kind, arm in zip(tables, kinds, arms, strict=True):
        if family(kind) != "static":
            raise InputError(
                "joint logs are not joined: each follows a clock of its own",
                file=table.path,
                column="kind",
                expected="touch or tracker; for a log --reference, or --model with what another log taught",
            )
        if arm.path.resolve() != arms[0].path.resolve():
            raise InputError(
                f"its robot is {arm.name} at {arm.path}",
                file=table.path,
                column="robot",
                expected=f"{arms[0].path} as in {tables[0].path}, or one --robot for all",
            )
        check_joints(table, arm)
        check_sizes(table)
    table, notes = joined(tables)
    found = _diagnosed(table, arms[0], model, progress, seed, {})
    return replace(found, notes=(*notes, *found.notes))


def _diagnosed(
    table: Table,
    arm: RobotModel,
    model: SavedModel | None,
    progress: Progress | None,
    seed: int,
    extra: dict[str, Any],
) -> Diagnosis:
    kind, noted = kind_of(table)
    check_joints(table, arm)
    if family(kind) == "static":
        check_sizes(table)
    if model is not None and model.kind != family(kind):
        raise InputError(
            f"the model given was learnt from {model.kind} recordings and this one is of kind {kind}",
            file=table.path,
            expected=f"a model of kind {family(kind)}",
        )
    engine = importlib.import_module(ENGINES[kind])
    table = replace(table, keys={**table.keys, "kind": kind})
    if family(kind) == "static":
        from app.diagnosis.doubts import check_arm, check_units, doubted

        check_units(table, arm)
        check_arm(table, arm)
        found: Diagnosis = engine.diagnose(table, arm, progress=progress, seed=seed, model=model)
        found = doubted(found, arm)
    else:
        found = engine.diagnose(table, arm, progress=progress, seed=seed, model=model, **extra)
    found = replace(found, file=str(table.path), kind=kind, notes=(*noted, *found.notes))
    if model is None:
        return found
    from app.diagnosis.judging import judge

    return replace(found, judged=judge(table, arm, model, found.outliers))


def family(kind: str) -> str:
    """ "static" or "motion": which models and effects belong to this kind of recording."""
    return "motion" if kind == "motion" else "static"


def kind_of(table: Table) -> tuple[str, tuple[str, ...]]:
    """The recording's kind, and a note where the header did not say it.

    Raises:
        InputError: a kind that another command reads, or none at all.
        UnknownNameError: a kind nobody knows.
    """
    kind = table.kind
    if kind is None:
        kind = _guessed_kind(table)
        if kind is None:
            raise MissingColumnError(
                "the header does not say what this recording is",
                file=table.path,
                row=1,
                column="kind",
                expected=f"a line '# kind: {' | '.join(ENGINES)}'",
            )
        return kind, (note("kind_guessed", kind=kind_name(kind)),)
    if kind in ELSEWHERE:
        raise InputError(
            f"a file of kind {kind} is read by `{ELSEWHERE[kind]}`",
            file=table.path,
            column="kind",
            expected=" or ".join(ENGINES),
        )
    if kind not in ENGINES:
        raise UnknownNameError(kind, available=ENGINES, what="kind", file=table.path, column="kind")
    return kind, ()


def _guessed_kind(table: Table) -> str | None:
    """By its columns, where only one kind has them."""
    has = table.columns
    if not any(re.fullmatch(r"q\d", name) for name in has):
        return None
    if "target" in has:
        return "touch"
    if "x" in has or "length" in has:
        return "tracker"
    if "t" in has and ("tau1" in has or "i1" in has):
        return "motion"
    return None


def robot_for(table: Table, named: str | None = None) -> RobotModel:
    """The robot named on the command line, else by the recording's header (a path is relative to the file).

    Raises:
        InputError: neither names one, or it cannot be loaded.
    """
    if named is not None:
        return load_robot(named)
    stated = table.keys.get("robot")
    if stated is None:
        raise MissingColumnError(
            "no robot is named",
            file=table.path,
            row=1,
            column="robot",
            expected="--robot NAME|FILE.urdf, or a line '# robot: NAME or path relative to the file'",
        )
    if not isinstance(stated, str):
        raise FileFormatError(
            f"found {str(stated)[:40]!r}",
            file=table.path,
            column="robot",
            expected="a robot's name or the path of a URDF",
        )
    try:
        return load_robot(stated, relative_to=Path(table.path).parent)
    except UnknownNameError as error:
        raise UnknownNameError(
            stated,
            available=error.available,
            what="robot (and no such file beside the recording)",
            file=table.path,
            column="robot",
        ) from None


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
        unit = {"mm": "m", "deg": "rad", "ms": "s"}.get(column.unit or "", column.unit or "")
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


def _reference(reference: str | Path, kind: str, path: str | Path, robot: RobotModel) -> Table:
    if kind != "motion":
        raise InputError(
            f"--reference is for motion recordings and this one is of kind {kind}",
            file=path,
            column="kind",
            expected="motion",
        )
    table = read_table(reference)
    other, _ = kind_of(table)
    if other != "motion":
        raise InputError(f"the reference is of kind {other}", file=reference, expected="motion")
    check_joints(table, robot)
    return table
