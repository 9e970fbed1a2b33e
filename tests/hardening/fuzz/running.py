"""Runs whole commands in this process on made-up files, and says what is not as promised.

Promised: an answer, or one of the project's own errors in one line; no answer later than 5 s; no NaN in JSON.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import signal
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.cli.commands import base, export, export_model, replay, solve
from app.errors import TeachframeError
from tests.hardening.fuzz import grammars, recordings

HANG = 5.0  # seconds of the processor: the clock says how busy a machine is


@dataclass(frozen=True)
class Kind:
    """A kind of file, how often it is made, and the command that reads it."""

    name: str
    share: float
    suffix: tuple[str, ...]
    make: Callable[[np.random.Generator], bytes]
    command: Callable[[Path, Path], object]


def _load(path: Path) -> None:
    from app.kinematics import load_robot

    load_robot(str(path))


def _read(path: Path) -> None:
    """A recording as a diagnosis begins: read, held against its robot, made arrays; the search takes seconds."""
    from app.diagnosis.dispatch import kind_of
    from app.diagnosis.dynamic.ready import ready
    from app.diagnosis.observations.pose_reading import read_static
    from app.recordings.arm import read_with_arm
    from app.recordings.matching import check_joints, check_sizes

    table, arm = read_with_arm(path, recordings.ROBOT)
    kind, _ = kind_of(table)
    check_joints(table, arm)
    if kind == "motion":
        ready(table, arm)
        return
    check_sizes(table)
    read_static(table, arm)


def _calibrate(path: Path) -> None:
    from app.kinematics import load_robot

    load_robot(f"ur5e#calibration={path}")


KINDS = (
    Kind(
        "controller", 0.63, (".mod", ".src", ".ls", ".script", ".xml", ".csv", ".json"),
        grammars.controller, lambda path, out: export.Command(path, to="json", out=None).run(),
    ),
    Kind(
        "model", 0.12, (".json",), grammars.model,
        lambda path, out: export_model.Command(path, out, to="mjcf", json=True).run(),
    ),
    Kind("journal", 0.07, (".jsonl",), grammars.journal, lambda path, out: replay.Command(str(path)).run()),
    Kind("points", 0.02, (".csv",), grammars.points, lambda path, out: solve.Command((path,), json=True).run()),
    Kind("arcs", 0.02, (".csv",), grammars.arcs, lambda path, out: base.Command(path, json=True).run()),
    Kind("recording", 0.04, (".csv",), recordings.recording, lambda path, out: _read(path)),
    Kind("rtde log", 0.02, (".csv",), recordings.rtde, lambda path, out: _read(path)),
    Kind("point list", 0.02, (".txt", ".csv"), recordings.point_list, lambda path, out: base.Command(path).run()),
    Kind("bag", 0.02, (".mcap", ".bag"), recordings.bag, lambda path, out: _read(path)),
    Kind("joint table", 0.01, (".csv",), recordings.joint_table, lambda path, out: _load(path)),
    Kind("calibration", 0.01, (".conf",), recordings.calibration, lambda path, out: _calibrate(path)),
    Kind("urdf", 0.02, (".urdf",), grammars.urdf, lambda path, out: _load(path)),
)  # fmt: skip


def _strict(text: str) -> None:
    raise ValueError(f"{text} in JSON")


def _too_long(number: int, frame: object) -> None:
    raise TimeoutError(f"no answer within {HANG:g} s")


def complaint(kind: Kind, data: bytes, folder: Path, suffix: str) -> str:
    """What is not as promised for this input; "" where all is well."""
    path, out = folder / f"fuzzed{suffix}", folder / "out.xml"
    path.write_bytes(data)
    said, errors = io.StringIO(), io.StringIO()
    signal.signal(signal.SIGPROF, _too_long)
    signal.setitimer(signal.ITIMER_PROF, HANG)
    try:
        with (
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(errors),
            warnings.catch_warnings(),
        ):
            warnings.simplefilter("ignore")
            kind.command(path, out)
    except TeachframeError as error:
        text = str(error)
        return "" if "\n" not in text and text.isprintable() else f"an error of several lines: {text!r}"
    except SystemExit:
        pass
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        return f"{type(error).__name__}: {error}"[:300]
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
    text = said.getvalue()
    for document in [text] if text.startswith("{\n") else text.splitlines():
        if document.startswith("{"):
            try:
                json.loads(document, parse_constant=_strict)
            except ValueError as error:
                return f"{error}: {document[:200]}"
    return ""


@contextlib.contextmanager
def silent():
    """Compiled libraries write to the terminal past Python: theirs is not this run's to show."""
    kept = os.dup(2)
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nothing)


def fuzz(inputs: int, seed: int, folder: Path) -> tuple[dict[str, int], list[str]]:
    """How many inputs of each kind were run, and one line for each that was not answered as promised.

    An input is made again by its kind and its two numbers: `seed` and its place in the run.
    """
    with silent():
        return _fuzzed(inputs, seed, folder)


def _fuzzed(inputs: int, seed: int, folder: Path) -> tuple[dict[str, int], list[str]]:
    counts, complaints = {}, []
    for kind in KINDS:
        counts[kind.name] = count = max(1, round(inputs * kind.share))
        for place in range(count):
            rng = np.random.default_rng([seed, place, len(kind.name)])
            suffix = kind.suffix[place % len(kind.suffix)]
            found = complaint(kind, kind.make(rng), folder, suffix)
            if found:
                complaints.append(f"{kind.name} {seed} {place}: {found}")
                if len(complaints) >= 20:
                    return counts, complaints
    return counts, complaints


def timed(inputs: int, seed: int, folder: Path) -> dict[str, float]:
    """Seconds an input of each kind takes, for choosing the shares."""
    out = {}
    for kind in KINDS:
        begun = time.perf_counter()
        for place in range(inputs):
            rng = np.random.default_rng([seed, place, len(kind.name)])
            complaint(kind, kind.make(rng), folder, kind.suffix[place % len(kind.suffix)])
        out[kind.name] = (time.perf_counter() - begun) / inputs
    return out
