"""What Compare does in a process of its own (app/apart.py): functions of plain arguments, `say` as the last."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from app.diagnosis.dispatch import diagnose_file
from app.diagnosis.model import SavedModel
from app.diagnosis.result import Diagnosis, Progress
from app.errors import InputError
from app.kinematics import robot_names
from app.panel import Upload
from app.screens._compare.dropped import take_in
from app.screens._compare.hidden import make_hidden, make_with
from app.screens._compare.loaded import Loaded, load

_NAMED = 6  # files named in a message


@dataclass(frozen=True)
class Arrived:
    """What came of a drop.

    Args:
        description: the robot's description, where one was dropped.
        loaded: the recording, where one was dropped.
    """

    description: Path | None
    loaded: Loaded | None


def read_drop(
    files: Sequence[Upload], folder: Path, robot: str | None, model: SavedModel | None, say: Progress
) -> Arrived:
    """Unpacks what was dropped into `folder` and reads the recording in it.

    Args:
        robot: whose recording it is; None takes a dropped description, else what the recording says itself.
    """
    say(0.0, "unpacking")
    found = take_in(files, folder)
    if len(found.recordings) > 1:
        names = ", ".join(sorted(path.name for path in found.recordings)[:_NAMED])
        raise InputError(f"several recordings were dropped: {names}", expected="one at a time")
    if not found.recordings:
        return Arrived(found.description, None)
    named = robot if robot is not None or found.description is None else str(found.description)
    return Arrived(found.description, load(found.recordings[0], robot=named, model=model, progress=say))


def read_again(
    path: Path, robot: str | None, truth: tuple[dict, ...], model: SavedModel | None, say: Progress
) -> Arrived:
    """Reads a recording that lies there."""
    return Arrived(None, load(path, robot=robot, truth=truth, model=model, progress=say))


def record_hidden(
    robot: str, kind: str, folder: Path, seed: int, model: SavedModel | None, say: Progress
) -> Arrived:
    """Records in a simulated cell with a hidden fault, and reads that."""
    say(0.0, "recording")
    path, truth = make_hidden(robot, kind, folder, seed)
    return read_again(path, _own(robot), truth, model, say)


def record_with(robot: str, kind: str, folder: Path, seed: int, model: SavedModel, say: Progress) -> Arrived:
    """Records in a simulated cell in which the model is true, and reads that."""
    say(0.0, "recording")
    return read_again(make_with(robot, kind, model, folder, seed), _own(robot), (), model, say)


def _own(robot: str) -> str | None:
    """An arm that a recording cannot name itself: it lies elsewhere."""
    return None if robot in robot_names() else robot


def search(path: Path, robot: str | None, model: SavedModel | None, say: Progress) -> Diagnosis:
    """Looks for what the simulation leaves out."""
    return diagnose_file(path, robot=robot, model=model, progress=say)
