"""One recording to one diagnosis: finds the robot, checks that the two belong together, picks the engine."""

from __future__ import annotations

import importlib
import re
from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path
from typing import Any

from app.diagnosis.model import SavedModel
from app.diagnosis.model_checks import applying, fitting
from app.diagnosis.result import Diagnosis, Progress
from app.diagnosis.wording import kind_name, note
from app.errors import InputError, MissingColumnError, UnknownNameError
from app.kinematics import RobotModel
from app.recordings import Table, read_table
from app.recordings.arm import read_with_arm
from app.recordings.joining import joined
from app.recordings.matching import check_joints, check_sizes
from app.recordings.options import ReadOptions
from app.steps import listened, part

#: Kind of recording -> the package whose `diagnose` reads it. Imported when needed.
ENGINES = {
    "touch": "app.diagnosis.kinematic.diagnose",
    "tracker": "app.diagnosis.kinematic.diagnose",
    "motion": "app.diagnosis.dynamic.diagnose",
}
#: Bytes that are read in the time of a search of ten thousand rows.
_AS_LONG = 30_000_000
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
    options: ReadOptions | None = None,
) -> Diagnosis:
    """Diagnoses one recording.

    Args:
        path: the recording.
        robot: a robot's address (name or path, and what was chosen in it); None takes the header's `# robot:`.
        reference: a motion recording of the same arm in a known good state.
        model: effects found before, taken as part of the robot.
        options: how to read files that do not say everything themselves.

    Raises:
        InputError: what was given cannot be used; names file, row and column.
        Cancelled: `progress` stopped it.
    """
    first = _reading(path)
    with _heard_reading(progress, first):  # the rows of a joint log; a static recording's are read later
        table, arm = read_with_arm(path, robot, options, check=kind_of)
    kind, _ = kind_of(table)
    extra = {} if reference is None else {"reference": _reference(reference, kind, path, arm)}
    with applying(model, path):
        return _diagnosed(table, arm, model, progress, seed, extra, first)


def diagnose_together(
    paths: Sequence[str | Path],
    *,
    robot: str | None = None,
    model: SavedModel | None = None,
    progress: Progress | None = None,
    seed: int = 0,
    options: ReadOptions | None = None,
) -> Diagnosis:
    """Diagnoses several touch or tracker recordings of one arm as one: what they share is the arm.

    Raises:
        InputError: one of them cannot be used, or they do not belong together.
        Cancelled: `progress` stopped it.
    """
    read = [read_with_arm(path, robot, options, check=kind_of) for path in paths]
    tables, arms = [table for table, _ in read], [arm for _, arm in read]
    kinds = [kind_of(table)[0] for table in tables]
    for table, kind, arm in zip(tables, kinds, arms, strict=True):
        if family(kind) != family(kinds[0]):
            raise InputError(
                f"a recording of kind {kind} and one of kind {kinds[0]} are not joined",
                file=table.path,
                column="kind",
                expected="touches and tracker points together, or joint logs together",
            )
        if (arm.path.resolve(), arm.flange) != (arms[0].path.resolve(), arms[0].flange):
            raise InputError(
                f"its robot is {arm.name} at {arm.path}",
                file=table.path,
                column="robot",
                expected=f"{arms[0].path} as in {tables[0].path}, or one --robot for all",
            )
        check_joints(table, arm)
        if family(kind) == "static":
            check_sizes(table)
    if family(kinds[0]) == "motion":
        return _logs_together(tables, arms[0], model, progress)
    table, notes = joined(tables)
    with applying(model, paths[0]):
        found = _diagnosed(table, arms[0], model, progress, seed, {})
    return replace(found, notes=(*notes, *found.notes))


def _logs_together(
    tables: Sequence[Table], arm: RobotModel, model: SavedModel | None, progress: Progress | None
) -> Diagnosis:
    from app.diagnosis.dynamic.diagnose import diagnose_together as learn

    if model is not None and model.kind != "motion":
        raise InputError(
            "the model given was learnt from static recordings", expected="a model of kind motion"
        )
    return learn(tables, arm, progress=progress, model=model)


def _diagnosed(
    table: Table,
    arm: RobotModel,
    model: SavedModel | None,
    progress: Progress | None,
    seed: int,
    extra: dict[str, Any],
    first: float = 0.0,
) -> Diagnosis:
    """A diagnosis; `first` is the share of it that reading the file is."""
    kind, noted = kind_of(table)
    check_joints(table, arm)
    if family(kind) == "static":
        check_sizes(table)
    if model is not None:
        fitting(model, arm, family(kind), table.path)
    engine = importlib.import_module(ENGINES[kind])

    def tell(share: float, doing: str) -> None:
        if progress is not None:
            progress(first + (1.0 - first) * share, doing)

    table = replace(table, keys={**table.keys, "kind": kind})
    if family(kind) == "static":
        from app.diagnosis.doubts import check_arm, check_units
        from app.diagnosis.observations.pose_reading import read_static

        with _heard_reading(progress, first):
            with part(0.0, 0.85):
                read_static(table, arm)  # the checks and the engine ask for it again
            with part(0.85, 1.0):
                check_units(table, arm)
                check_arm(table, arm)
        found: Diagnosis = engine.diagnose(table, arm, progress=tell, seed=seed, model=model)
    else:
        found = engine.diagnose(table, arm, progress=tell, seed=seed, model=model, **extra)
    found = replace(found, file=str(table.path), kind=kind, notes=(*table.notes, *noted, *found.notes))
    if model is None:
        return found
    from app.diagnosis.judging import judge

    return replace(found, judged=judge(table, arm, model))


def _heard_reading(progress: Progress | None, first: float) -> AbstractContextManager[None]:
    """What is read within is the first share of all that is told."""
    return listened(lambda share, doing: progress and progress(first * share, doing), "reading")


def _reading(path: str | Path) -> float:
    """Share of a diagnosis that reading takes: it grows with the file; the search works on so many rows at most."""
    path = Path(path)
    size = path.stat().st_size if path.is_file() else 0
    return size / (size + _AS_LONG)


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
