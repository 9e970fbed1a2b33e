"""Many recordings, on all cores or on a Dask cluster: one row a file, nothing done twice."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import tyro

from app.cli.arguments import ReadingArguments, RobotArguments
from app.errors import InputError

if TYPE_CHECKING:
    from app.cli.progress import Shown
    from app.fleet.run import Counts, Workers
    from app.fleet.work import Settings

#: Where no bar can be shown: seconds, or share of the whole, between two lines.
_LINE, _SHARE = 30.0, 0.05


@dataclass
class Command:
    """Many recordings, on all cores or on a Dask cluster: one row a file, nothing done twice.

    The rows stay on the disk as they come: a run that was stopped goes on where it was, by the same command. A file
    that cannot be read is a row with its one line. What many recordings say together comes to stdout and, with
    --report, as a page.
    """

    where: Annotated[Path, tyro.conf.Positional, tyro.conf.arg(metavar="DIR|LIST")]
    """A folder, searched with all below it, or a text file with one path a line."""

    out: Annotated[Path, tyro.conf.arg(metavar="RESULTS.parquet")]
    """The rows: file, arm, when, kind, verdict, errors before and after, the whole diagnosis, or why there is none."""

    scheduler: Annotated[str | None, tyro.conf.arg(metavar="ADDRESS")] = None
    """A Dask scheduler, tcp://HOST:8786; its workers see the same files. Without it the cores of this machine."""

    processes: Annotated[int | None, tyro.conf.arg(metavar="N")] = None
    """Processes on this machine; without it one a core."""

    resume: bool = True
    """Keep the rows of files whose content, program and settings are the same; --no-resume does all of them anew."""

    limit_s: float = 600.0
    """Seconds one file may take."""

    report: Annotated[Path | None, tyro.conf.arg(metavar="OUT.html")] = None
    """Write the summary as a page."""

    language: Literal["en", "zh"] = "en"
    """Of the summary."""

    arm: tyro.conf.OmitArgPrefixes[RobotArguments] = field(default_factory=RobotArguments)
    """The robot, where the files do not name it."""

    reading: tyro.conf.OmitArgPrefixes[ReadingArguments] = field(default_factory=ReadingArguments)
    """How to read files that leave something open."""

    reference: Annotated[Path | None, tyro.conf.arg(metavar="FILE")] = None
    """A motion recording of the same arm in a known good state."""

    model: Annotated[Path | None, tyro.conf.arg(metavar="IN.json")] = None
    """A saved model, taken as part of the robot."""

    seed: Annotated[int, tyro.conf.arg(metavar="N")] = 0
    """Seed of the null distribution."""

    def run(self) -> int:
        from app.cli.progress import shown_progress
        from app.files import check_writable, write_text
        from app.fleet.finding import recordings
        from app.fleet.ledger import Ledger, read_rows
        from app.fleet.run import run
        from app.fleet.summary import as_page, as_text, summarised

        settings = self._settings()
        if self.report is not None:
            check_writable(self.report)
        files = recordings(self.where, but=self.out)
        workers = self._workers(settings)
        ledger = Ledger(self.out, fresh=not self.resume)
        root = self.where if self.where.is_dir() else self.where.parent
        try:
            with shown_progress(len(files)) as progress:
                counts = run(files, root, ledger, settings, workers, _Told(progress))
            left_out = ledger.left_out()
            ledger.write()
        except KeyboardInterrupt:
            print(
                f"stopped; what is done is kept in {self.out}.part: the same command goes on", file=sys.stderr
            )
            raise
        finally:
            ledger.close()
            workers.close()
        done = f"{counts.total} recordings: {counts.done} done now, {counts.kept} known from before"
        print(f"{done}, {counts.broken} without a diagnosis: {self.out}", file=sys.stderr)
        if left_out:
            print(f"{left_out} rows of files that are no longer given were left out", file=sys.stderr)
        summary = summarised(read_rows(self.out), ledger.run)
        sys.stdout.write(as_text(summary, self.language))
        if self.report is not None:
            write_text(self.report, as_page(summary, self.language))
            print(f"report: {self.report}", file=sys.stderr)
        return 0

    def _settings(self) -> Settings:
        from app.diagnosis.model import load_model
        from app.files import check_readable
        from app.fleet.work import Settings
        from app.kinematics import load_robot

        if self.out.suffix != ".parquet":
            raise InputError(
                "results of another kind", file=self.out, expected="a name that ends in .parquet"
            )
        if not 0 < self.limit_s < 1e7:
            raise InputError(f"found {self.limit_s:g}", column="--limit-s", expected="above 0")
        if self.processes is not None and not 1 <= self.processes <= 1024:
            raise InputError(f"found {self.processes}", column="--processes", expected="1 to 1024")
        if self.arm.robot is not None:
            if Path(self.arm.robot).is_file():  # workers may stand in another folder
                self.arm.robot = str(Path(self.arm.robot).absolute())
            load_robot(str(self.arm.address))
        if self.model is not None:
            load_model(self.model)
        if self.reference is not None:
            check_readable(self.reference, "a recording")
        return Settings(
            robot=self.arm.address,
            reference=None if self.reference is None else self.reference.absolute(),
            model=None if self.model is None else self.model.absolute(),
            options=self.reading.options,
            seed=self.seed,
            limit=self.limit_s,
        )

    def _workers(self, settings: Settings) -> Workers:
        from app.fleet.keys import program

        if self.scheduler is None:
            from app.fleet.local import Local

            return Local(settings, program(), self.processes)
        from app.fleet.cluster import Cluster

        return Cluster(
            self.scheduler, settings, program(), lambda line: print(line, file=sys.stderr, flush=True)
        )


class _Told:
    """How far it is: a bar where a person watches, a line now and then where stderr is a file."""

    def __init__(self, progress: Shown):
        self._progress, self._last, self._at = progress, time.monotonic(), 0

    def __call__(self, counts: Counts) -> None:
        at = counts.kept + counts.done
        said = f"{at} of {counts.total}, {counts.broken} broken"
        if counts.left is not None:
            said += f", {_time(counts.left)} left"
        self._progress.update(at / counts.total, said)
        now = time.monotonic()
        due = now - self._last > _LINE or at - self._at >= max(1.0, _SHARE * counts.total)
        if due and counts.done and not self._progress.watched:
            self._last, self._at = now, at
            print(said, file=sys.stderr, flush=True)


def _time(seconds: float) -> str:
    hours, rest = divmod(round(seconds), 3600)
    return (
        f"{hours} h {rest // 60} min"
        if hours
        else f"{rest // 60} min {rest % 60} s"
        if rest >= 60
        else f"{rest} s"
    )
