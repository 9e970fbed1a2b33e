"""Joint logs of real arms: the diagnosis beside plain least squares, held out and carried to another log of the arm.

    python -m benchmarks ordinary_motion [FOLDER ...] [--write]      folders with run_a.csv, ...; all of TEACHFRAME_DATA

The peer is _ordinary.py on the very same windows, with the rotor's inertia and without it, whichever is better there.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.judging import judged
from app.diagnosis.dynamic.ready import ready
from app.diagnosis.model import SavedModel
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.samples import Samples, take
from app.kinematics import RobotModel
from app.recordings import Table, read_table
from app.recordings.arm import robot_for
from benchmarks._document import DOCS, markdown, replace_section
from benchmarks._ordinary import columns, fit, heldout, time_folds
from benchmarks.real_static import data_folder
from benchmarks.rows import Row

WORSE = 1.01  # times the peer's error: beyond, the line is in bold


@dataclass(frozen=True, eq=False)
class Log:
    """One log with its windows as they are given."""

    path: Path
    table: Table
    robot: RobotModel
    samples: Samples


@dataclass(frozen=True)
class Line:
    """Torque error on one log [Nm or N]: of the description, held out, and of what another log taught."""

    log: str
    learnt_on: str
    description: float
    ours: float
    peer: float
    verdict: str = ""


def compare(folder: Path) -> list[Line]:
    """Every log of a folder held out by stretches of time, and judged by what every other log taught."""
    logs = [read(p) for p in sorted(folder.glob("run_*.csv"))]
    out: list[Line] = []
    for log in logs:
        found = diagnose(log.table, log.robot)
        model = msgspec.convert(dict(found.model), SavedModel)
        name = f"{folder.name}/{log.path.stem}"
        own = min(
            rms(heldout(columns(log.samples.state, r), log.samples.y, _folds(log))) for r in (False, True)
        )
        out.append(
            Line(name, "itself, held out", found.before.fit_rms, found.after.heldout_rms, own, found.verdict)
        )
        for other in logs:
            if other is log:
                continue
            before, after = judged(other.table, other.robot, model).qualities
            peer = carried(log, other)
            out.append(
                Line(f"{folder.name}/{other.path.stem}", log.path.stem, before.fit_rms, after.fit_rms, peer)
            )
    return out


def carried(log: Log, other: Log) -> float:
    """Error on another log of least squares on one, with the rotors' inertia or without it, whichever is better."""
    state, there = log.samples.state, other.samples
    return min(
        rms(there.y - columns(there.state, rotor) @ fit(columns(state, rotor), log.samples.y))
        for rotor in (False, True)
    )


def read(path: Path) -> Log:
    """A log with its windows."""
    table = read_table(path)
    robot = robot_for(table)
    log, motion, _ = ready(table, robot)
    return Log(path, table, robot, take(log, robot, motion, as_given(robot.joint_count)))


def _folds(log: Log) -> np.ndarray:
    return time_folds(len(log.samples.y))


def rms(residual: np.ndarray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(residual**2)))


def folders(named: list[str]) -> list[Path]:
    """Those named, or all joint logs of the data folder."""
    return [Path(n) for n in named] or sorted(
        p for p in data_folder().glob("*_motion") if any(p.glob("run_*.csv"))
    )


def run() -> list[Row]:
    """Held-out and carried torque error beside the ordinary peer's."""
    return [
        Row(
            f"torque error {line.log}, learnt on {line.learnt_on}",
            line.ours,
            line.peer,
            "least squares",
            "Nm",
        )
        for folder in folders([])
        for line in compare(folder)
    ]


def section(lines: list[Line]) -> str:
    """The document's section on joint logs."""
    rows = [
        (
            line.log, line.learnt_on, f"{line.description:.4g}", f"{line.peer:.4g}",
            f"{line.ours:.4g}" if line.ours <= WORSE * line.peer else f"**{line.ours:.4g}**", line.verdict,
        )
        for line in lines
    ]  # fmt: skip
    head = (
        "## Joint logs\n\nTorque error (Nm, N where a joint slides; rms over all joints), by `python -m benchmarks "
        "ordinary_motion --write`. Held out by\nstretches of time, or carried: nothing is fitted to the log that is "
        "judged. Least squares: base inertial parameters, viscous and dry\nfriction, offset, with the rotor's inertia "
        "or without it, whichever is better there, on the same windows. In bold where it is better\nthan the program "
        "by more than 1%.\n\n"
    )
    heads = ("log", "learnt on", "description", "least squares", "program", "verdict")
    return head + markdown(heads, rows)


def command(named: list[str]) -> int:
    """Prints the table; `--write` puts it into the document."""
    write = "--write" in named
    lines: list[Line] = []
    print(
        f"{'log':<28}{'learnt on':<18}{'description':>12}{'ours':>10}{'peer':>10}{'ours/peer':>11}  verdict"
    )
    for chosen in folders([n for n in named if n != "--write"]):
        for line in compare(chosen):
            lines.append(line)
            print(
                f"{line.log:<28}{line.learnt_on:<18}{line.description:>12.4g}{line.ours:>10.4g}{line.peer:>10.4g}"
                f"{line.ours / line.peer:>11.2f}  {line.verdict}",
                flush=True,
            )
    if write:
        replace_section(DOCS / "real_recordings.md", "motion", section(lines))
    return 0


if __name__ == "__main__":
    sys.exit(command(sys.argv[1:]))
