"""Many recordings side by side on all cores: results in the order given, one bad file stops no other."""

from __future__ import annotations

import multiprocessing
import os
import signal
import warnings
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from pathlib import Path

from app.diagnosis.dispatch import diagnose_file
from app.diagnosis.model import SavedModel
from app.diagnosis.result import Diagnosis
from app.errors import TeachframeError, one_line
from app.recordings.options import ReadOptions


@dataclass(frozen=True)
class Outcome:
    """What came of one file: a diagnosis, or one line that says why not.

    Args:
        fault: True where the line is this program's own failure, False where the input is at fault.
    """

    file: str
    diagnosis: Diagnosis | None
    error: str = ""
    fault: bool = False


def diagnose_many(
    files: Sequence[Path],
    *,
    robot: str | None = None,
    reference: Path | None = None,
    model: SavedModel | None = None,
    evidence: bool = False,
    seed: int = 0,
    options: ReadOptions | None = None,
) -> Iterator[Outcome]:
    """Outcomes in the order of `files`, each as soon as it and all before it are there.

    Args:
        evidence: True brings back what pictures are drawn from; False leaves it, which is lighter.
    """
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # read by the workers when they start
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    common = (robot, reference, model, evidence, seed, options)
    waiting = list(files)
    while waiting:
        with worker_pool(min(cores(), len(waiting))) as pool:
            futures = [pool.submit(_outcome, path, *common) for path in waiting]
            done = 0
            try:
                for future in futures:
                    yield future.result()
                    done += 1
            except BrokenProcessPool:
                pass
            finally:
                _cancel(futures)
        waiting = waiting[done:]
        if waiting:  # a worker died (memory, a crash below Python): who did it shows only alone
            yield _alone(waiting.pop(0), common)


def cores() -> int:
    """Processor cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def worker_pool(workers: int) -> ProcessPoolExecutor:
    """Processes of their own, each with one thread and without the warnings of libraries."""
    return ProcessPoolExecutor(workers, multiprocessing.get_context("spawn"), initializer=_quiet)


def _quiet() -> None:
    """Warnings of libraries are for developers; so is the trace of an interrupt, which the parent answers."""
    if not os.environ.get("TEACHFRAME_DEBUG"):
        warnings.simplefilter("ignore")
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _cancel(futures: Sequence[Future[Outcome]]) -> None:
    for future in futures:
        future.cancel()


def _alone(path: Path, common: tuple) -> Outcome:
    with worker_pool(1) as pool:
        try:
            return pool.submit(_outcome, path, *common).result()
        except BrokenProcessPool:
            return Outcome(str(path), None, f"{path}: the process that read it died (out of memory?)", True)


def _outcome(
    path: Path,
    robot: str | None,
    reference: Path | None,
    model: SavedModel | None,
    evidence: bool,
    seed: int,
    options: ReadOptions | None,
) -> Outcome:
    try:
        found = diagnose_file(path, robot=robot, reference=reference, model=model, seed=seed, options=options)
    except TeachframeError as error:
        return Outcome(str(path), None, str(error))
    except Exception as error:
        if os.environ.get("TEACHFRAME_DEBUG"):
            raise
        return Outcome(
            str(path), None, one_line(f"{path}: internal fault ({type(error).__name__}: {error})", 240), True
        )
    return Outcome(str(path), found if evidence else replace(found, evidence=None))
