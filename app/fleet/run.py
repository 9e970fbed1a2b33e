"""What is left to do, done: files whose work is known are not worked on, and none is worked on twice at once."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import msgspec

from app.errors import one_line
from app.fleet.finding import arm_of, dated
from app.fleet.keys import content_key, program, settings_key
from app.fleet.ledger import Ledger
from app.fleet.work import Job, OtherVersionError, Row, Settings

_RECENT = 200  # rows whose pace tells how long the rest will take


class Workers(Protocol):
    """Who does the work: this machine, or a cluster."""

    def rows(self, jobs: Iterator[Job]) -> Iterator[Row]:
        """Takes jobs as it needs them; gives their rows as they come, each once."""
        ...

    def close(self) -> None:
        """Lets go of it."""
        ...


@dataclass
class Counts:
    """How far a run is.

    Args:
        total: files given.
        kept: of them known from before.
        done: worked on now.
        broken: of all, without a diagnosis.
        left: seconds until the end at the pace of late; None before there is a pace.
        run: its number.
    """

    total: int
    kept: int = 0
    done: int = 0
    broken: int = 0
    left: float | None = None
    run: int = 1


def run(
    files: list[Path],
    root: Path,
    ledger: Ledger,
    settings: Settings,
    workers: Workers,
    told: Callable[[Counts], None],
) -> Counts:
    """Works on all files that the ledger has no row of.

    Args:
        files: the recordings.
        root: the folder that was given, for whose each is.
        told: called after each file.

    Raises:
        InputError: the cluster cannot do it; what is done is in the ledger.
    """
    return _Run(files, root, ledger, settings, told).through(workers)


class _Run:
    def __init__(
        self,
        files: list[Path],
        root: Path,
        ledger: Ledger,
        settings: Settings,
        told: Callable[[Counts], None],
    ):
        self._files, self._root, self._ledger, self._settings, self._told = (
            files,
            root,
            ledger,
            settings,
            told,
        )
        self._version, self._asked = program(), settings_key(settings)
        self._waiting: dict[str, list[Path]] = {}  # key -> files that wait for its row
        self._counts = Counts(len(files), run=ledger.run)
        self._ends: deque[float] = deque(maxlen=_RECENT)

    def through(self, workers: Workers) -> Counts:
        self._ledger.give([str(path) for path in self._files])
        for row in workers.rows(self._jobs()):
            if row.version != self._version:
                raise OtherVersionError(f"a worker runs teachframe {row.version}", expected=self._version)
            for path in self._waiting.pop(row.key):
                self._keep(row, path)
                self._tell(done=True)
        return self._counts

    def _jobs(self) -> Iterator[Job]:
        for path in self._files:
            try:
                key = content_key(path)
            except OSError as error:
                said = one_line(f"{path}: cannot be read ({error.strerror})")
                self._keep(Row(str(path), "", self._version, error=said, reason="input"), path)
                self._tell(done=True)
                continue
            if key in self._waiting:
                self._waiting[key].append(path)
            elif self._known(path, key):
                self._tell(done=False)
            else:
                self._waiting[key] = [path]
                yield Job(str(path.absolute()), key)

    def _known(self, path: Path, key: str) -> bool:
        """True where the work was done: this file's row stands, or that of another with the same content is taken."""
        row = self._ledger.row(str(path))
        same = row is not None and (row.key, row.version, row.settings) == (key, self._version, self._asked)
        if row is not None and same and not self._was_short(row):
            self._counts.broken += bool(row.error)
            return True
        row = self._ledger.same(key, self._version, self._asked)
        if row is None or self._was_short(row):
            return False
        self._keep(row, path)
        return True

    def _was_short(self, row: Row) -> bool:
        """True where a row has no result for lack of time and there is more now."""
        return row.reason == "time" and row.limit < self._settings.limit

    def _keep(self, row: Row, path: Path) -> None:
        """The row, as that of this file."""
        stated, said = (row.arm, row.dated) if row.dated not in ("header", "name", "file") else ("", "")
        when, source = dated(path, said)
        kept = msgspec.structs.replace(
            row,
            file=str(path),
            settings=self._asked,
            run=self._counts.run,
            arm=stated or arm_of(path, self._root) or row.robot,
            recorded=when,
            dated=source,
            error=row.error.replace(row.file, str(path)),
        )
        self._ledger.add(kept)
        self._counts.broken += bool(kept.error)

    def _tell(self, *, done: bool) -> None:
        counts = self._counts
        counts.done, counts.kept = counts.done + done, counts.kept + (not done)
        if done:
            self._ends.append(time.monotonic())
        if len(self._ends) > 1 and self._ends[-1] > self._ends[0]:
            pace = (len(self._ends) - 1) / (self._ends[-1] - self._ends[0])
            counts.left = (counts.total - counts.kept - counts.done) / pace
        self._told(counts)
