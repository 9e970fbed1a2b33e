"""One recording to one row: what came of it, or one line that says why not. The same here and on a cluster."""

from __future__ import annotations

import faulthandler
import os
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import msgspec

from app import __version__
from app.diagnosis.dispatch import diagnose_file
from app.diagnosis.model import load_model
from app.diagnosis.result import Cancelled
from app.errors import InputError, TeachframeError, one_line
from app.recordings import read_table
from app.recordings.options import ReadOptions

#: Why there is no result: the input, the time, a process that ended, this program.
Reason = Literal["", "input", "time", "died", "fault"]
#: A file that does not look at the clock ends its process after this many times its time, and so many seconds.
HARD, GRACE = 2.0, 10.0
#: The watch over a process knows one deadline: a process works on one file at a time.
_ONE = threading.Lock()


@dataclass(frozen=True)
class Settings:
    """What is asked of every recording.

    Args:
        robot: an address; None takes each header's.
        reference: a motion recording of the same arm in a good state.
        model: a saved model, taken as part of the robot.
        options: how to read files that leave something open.
        seed: of the null distribution.
        limit: seconds one file may take.
    """

    robot: str | None = None
    reference: Path | None = None
    model: Path | None = None
    options: ReadOptions = field(default_factory=ReadOptions)
    seed: int = 0
    limit: float = 600.0

    def asked(self) -> dict[str, Any]:
        """All that a result depends on, as plain data; the limit is not among it."""
        plain = {"robot": self.robot, "seed": self.seed, "reference": self.reference, "model": self.model}
        options = {name: getattr(self.options, name) for name in self.options.__dataclass_fields__}
        return {name: str(value) for name, value in {**plain, **options}.items()}


class Job(msgspec.Struct, frozen=True):
    """One recording to be worked on: its file and what its work is known by."""

    file: str
    key: str


class Row(msgspec.Struct):
    """What came of one file.

    Args:
        file: its path, as given.
        key: of its content.
        version: of the program that made the row.
        settings: key of what was asked.
        run: number of the run that made it, from 1.
        arm, recorded, dated: whose it is, when it was made [s since 1970], and what says so.
        kind, robot, samples, verdict, unit, before, after: as a diagnosis says; `before` and `after` are held-out.
        diagnosis: all of it, as JSON.
        error, reason: one line where there is no diagnosis, and why.
        seconds: it took.
        limit: seconds it was given, where the time was the reason.
    """

    file: str
    key: str
    version: str = ""
    settings: str = ""
    run: int = 0
    arm: str = ""
    recorded: float | None = None
    dated: str = ""
    kind: str = ""
    robot: str = ""
    samples: int = 0
    verdict: str = ""
    unit: str = ""
    before: float | None = None
    after: float | None = None
    diagnosis: str = ""
    error: str = ""
    reason: Reason = ""
    seconds: float = 0.0
    limit: float = 0.0


class OtherVersionError(InputError):
    """A worker of the cluster runs another version of this program."""


def work(job: Job, settings: Settings, version: str) -> Row:
    """The row of one recording; a mistake in the input is a row too.

    Raises:
        OtherVersionError: this process runs another version than was asked for.
    """
    if version != __version__:
        raise OtherVersionError(f"a worker runs teachframe {__version__}", expected=f"{version} on all")
    with _ONE, Path(os.devnull).open("w") as nowhere:
        begun = time.monotonic()
        row = Row(job.file, job.key, version)
        faulthandler.dump_traceback_later(HARD * settings.limit + GRACE, exit=True, file=nowhere)
        try:
            _fill(row, settings, begun)
        except Cancelled:
            row.error, row.reason = f"{job.file}: longer than {settings.limit:g} s", "time"
            row.limit = settings.limit
        except TeachframeError as error:
            row.error, row.reason = str(error), "input"
        except MemoryError:
            row.error, row.reason = f"{job.file}: more memory than there is", "died"
        except Exception as error:
            said = f"{job.file}: internal fault ({type(error).__name__}: {error})"
            row.error, row.reason = one_line(said, 240), "fault"
        finally:
            faulthandler.cancel_dump_traceback_later()
        row.seconds = round(time.monotonic() - begun, 3)
        return row


def died(job: Job, version: str, seconds: float, limit: float) -> Row:
    """The row of a recording whose process ended without an answer."""
    late = seconds >= HARD * limit
    what = f"longer than {limit:g} s" if late else "the process that read it died (out of memory?)"
    reason: Reason = "time" if late else "died"
    return Row(
        job.file, job.key, version, error=f"{job.file}: {what}", reason=reason, seconds=seconds, limit=limit
    )


def _fill(row: Row, settings: Settings, begun: float) -> None:
    def progress(_share: float, _doing: str) -> None:
        if time.monotonic() - begun > settings.limit:
            raise Cancelled("out of time")

    keys = read_table(row.file, settings.options).keys
    row.arm, row.dated = str(keys.get("arm") or "")[:80], str(keys.get("recorded") or "")[:40]
    model = None if settings.model is None else load_model(settings.model)
    found = diagnose_file(
        row.file,
        robot=settings.robot,
        reference=settings.reference,
        model=model,
        progress=progress,
        seed=settings.seed,
        options=settings.options,
    )
    row.kind, row.robot, row.samples, row.verdict = found.kind, found.robot, found.samples, found.verdict
    row.unit, row.before, row.after = found.before.unit, found.before.heldout_rms, found.after.heldout_rms
    row.diagnosis = msgspec.json.encode(found.to_json()).decode()
