"""Whole commands in processes of their own, and what they used: for files that might take the process with them.

The processes are forked from a small server that has read the program once, as the pendant's own (app/apart.py).
"""

from __future__ import annotations

import multiprocessing
import os
import resource
import signal
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.apart import prepare

#: Processor time of a command on a small hostile file [s]; the clock says how busy a machine is.
MOST_SECONDS = 5.0
#: Memory of it [MB].
MOST_MEMORY = 1000.0
_GIVEN_UP_S = 180.0
_MOST_CPU_S = 40
_CONTEXT: Any = multiprocessing.get_context("forkserver")
prepare(
    [
        "app.cli", "app.calibration.solving", "app.calibration.base.run", "app.calibration.exchange",
        "app.diagnosis.kinematic.diagnose", "app.diagnosis.dynamic.diagnose", "app.diagnosis.export",
        "app.session.store", "app.recordings.arm", "app.proof.generator.simulate", "app.kinematics.loading",
    ]
)  # fmt: skip


@dataclass(frozen=True)
class Ran:
    """What a command said and used: processor time [s], memory [MB]."""

    code: int
    out: str
    err: str
    seconds: float
    memory: float


def ran(*argv: object, folder: Path) -> Ran:
    """A command in a process of its own; one that dies has the signal as its code, negative."""
    ours, theirs = _CONTEXT.Pipe(duplex=False)
    said, errors = folder / ".said", folder / ".errors"
    words = [str(word) for word in argv]
    process = _CONTEXT.Process(target=_work, args=(theirs, words, str(folder), str(said), str(errors)))
    process.start()
    theirs.close()
    process.join(_GIVEN_UP_S)
    process.kill()
    process.join()
    out, err = (path.read_text(encoding="utf-8", errors="replace") for path in (said, errors))
    if process.exitcode != 0 or not ours.poll():
        return Ran(process.exitcode or -1, out, err, 1e9, 1e9)
    code, seconds, memory = ours.recv()
    return Ran(code, out, err, seconds, memory)


def _work(answer: Any, argv: list[str], folder: str, said: str, errors: str) -> None:
    from app.cli import run

    os.chdir(folder)
    for number, path in ((1, said), (2, errors)):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600), number)
    resource.setrlimit(resource.RLIMIT_CPU, (_MOST_CPU_S, _MOST_CPU_S + 1))
    signal.alarm(int(_GIVEN_UP_S))
    begun = _used()
    code = run(argv)
    seconds = _used() - begun
    most = next(v for v in Path("/proc/self/status").read_text().splitlines() if v.startswith("VmHWM"))
    answer.send((code, seconds, int(most.split()[1]) / 1e3))


def _used() -> float:
    """Processor time of this process and of those it waited for [s]."""
    all_ = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(used.ru_utime + used.ru_stime for used in all_)


def refused(*argv: object, folder: Path) -> str:
    """The one line with which a command refuses what it was given, within the bounds."""
    found = ran(*argv, folder=folder)
    line = found.err.rstrip("\n")
    assert found.code == 2 and line and "\n" not in line and line.isprintable(), found
    assert found.seconds < MOST_SECONDS and found.memory < MOST_MEMORY, found
    return line
