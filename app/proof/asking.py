"""Asks the diagnosis: one recording at a time, through its file and nothing else."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from app.errors import TeachframeError


def ask(path: Path, without: str = "") -> dict[str, Any]:
    """What the diagnosis says of a file, as its JSON; a refusal or a fault is an answer too.

    Args:
        without: an effect taken out of the library first (a negative control).
    """
    from app import catalog
    from app.diagnosis.dispatch import diagnose_file

    begun = time.perf_counter()
    packages = [f"app.diagnosis.effects.{family}" for family in ("static", "motion")] if without else []
    taken = {p: catalog.members(p, "EFFECT").pop(without, None) for p in packages}
    try:
        said = diagnose_file(path).to_json()
    except TeachframeError as error:
        said = {"error": f"{type(error).__name__}: {error}"}
    except Exception as error:  # a fault of the diagnosis is a failure of the case, not of the proof
        said = {"error": f"fault, {type(error).__name__}: {error}"}
    finally:
        for package, effect in taken.items():
            if effect is not None:
                catalog.members(package, "EFFECT")[without] = effect
    return {**said, "wall_seconds": time.perf_counter() - begun}


def everywhere(
    work: Callable[..., Any], jobs: Sequence[tuple], say: Callable[[float], None], workers: int | None = None
) -> list[Any]:
    """`work(*job)` of every job on all cores, in the order of the jobs."""
    workers = workers or max(1, _cores())
    if workers == 1 or len(jobs) == 1:
        return [_told(work(*job), say, (i + 1) / len(jobs)) for i, job in enumerate(jobs)]
    out: list[Any] = [None] * len(jobs)
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        waiting = {pool.submit(work, *job): i for i, job in enumerate(jobs)}
        for done, future in enumerate(as_completed(waiting), 1):
            out[waiting[future]] = future.result()
            say(done / len(jobs))
    return out


def _told(result: Any, say: Callable[[float], None], share: float) -> Any:
    say(share)
    return result


def _cores() -> int:
    """Cores this process may use (3.11 has no os.process_cpu_count)."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
