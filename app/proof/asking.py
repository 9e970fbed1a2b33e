"""Asks the diagnosis: one recording at a time, through its file and nothing else."""

from __future__ import annotations

import os
import pkgutil
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from app.errors import TeachframeError

#: The step of `judged` that holds the error of a saved model.
WITH = "with the model"


def ask(path: Path, without: str = "") -> dict[str, Any]:
    """What the diagnosis says of a file, as its JSON; a refusal or a fault is an answer too.

    Args:
        without: an effect taken out of the library first (a negative control).
    """
    from app import catalog

    families = [catalog.members(package, "EFFECT") for package in _libraries()] if without else []
    whole = [dict(family) for family in families]
    for family in families:
        family.pop(without, None)
    try:
        return _diagnosed(path)[0]
    finally:  # in the order they had: whoever asks next in this process finds the library as it was
        for family, members in zip(families, whole, strict=True):
            family.clear()
            family.update(members)


def ask_whole(path: Path, second: Path, reference: Path | None = None) -> dict[str, Any]:
    """What the diagnosis says of a recording, and how well the model it saves does.

    Under `judged` stand the errors of the saved model on the recording itself (`self`) and on another of the same
    arm (`second`): as `diagnose FILE --save-model M --json`, then `diagnose FILE --model M --json` of either. Against a
    reference only what changed since is asked for, as `diagnose FILE --reference REFERENCE --json`.
    """
    from app.diagnosis.model import load_model, model_of, save_model

    if reference is not None:
        return _diagnosed(path, reference=reference)[0]
    said, found = _diagnosed(path)
    judged: dict[str, Any] = {}
    if found is not None:
        saved, model = path.with_suffix(".model.json"), None
        try:
            save_model(model_of(found), saved)
            model = load_model(saved)
        except (
            TeachframeError
        ) as error:  # nothing was found, or it cannot be read again: the description is the model
            judged["unsaved"] = str(error)
        for name, file in (("self", path), ("second", second)):
            told, _ = _diagnosed(file, model=model) if model else _diagnosed(file)
            steps = (told.get("judged") or {}).get("steps") or {}
            judged[name] = steps.get(WITH) if model else told.get("before")
            if "error" in told:
                judged[f"{name}_error"] = told["error"]
    return {**said, "whole": judged}


def _libraries() -> list[str]:
    """The packages whose members are the effects the diagnosis knows."""
    from app.diagnosis import effects

    found = pkgutil.iter_modules(effects.__path__, f"{effects.__name__}.")
    return [info.name for info in found if info.ispkg]


def _diagnosed(path: Path, **options: Any) -> tuple[dict[str, Any], Any]:
    """The JSON, and the diagnosis itself unless it was refused or failed."""
    from app.diagnosis.dispatch import diagnose_file

    begun, found = time.process_time(), None
    try:
        found = diagnose_file(path, **options)
        said = found.to_json()
    except TeachframeError as error:
        said = {"error": f"{type(error).__name__}: {error}"}
    except Exception as error:  # a fault of the diagnosis is a failure of the case, not of the proof
        said = {"error": f"fault, {type(error).__name__}: {error}"}
    return {**said, "processor_seconds": time.process_time() - begun}, found


def everywhere(
    work: Callable[..., Any],
    jobs: Sequence[tuple],
    say: Callable[[float], None],
    processes: int | None = None,
) -> list[Any]:
    """`work(*job)` of every job, in the order of the jobs.

    Args:
        processes: side by side, each on one core; all cores unless given. One: in this process.
    """
    processes = processes or max(1, _cores())
    if processes == 1 or len(jobs) == 1:
        return [_told(work(*job), say, (i + 1) / len(jobs)) for i, job in enumerate(jobs)]
    out: list[Any] = [None] * len(jobs)
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # read by the processes when they start
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
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
