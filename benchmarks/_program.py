"""The diagnosis as a user runs it: learnt on some recordings, its saved model judged on another run."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from app.diagnosis.dispatch import diagnose_file, diagnose_together
from app.diagnosis.judging import WITH, judge
from app.diagnosis.model import model_of
from app.diagnosis.result import Diagnosis
from app.errors import TeachframeError
from app.recordings import Table, read_table
from app.recordings.arm import robot_for


@dataclass(frozen=True, eq=False)
class Learnt:
    """A diagnosis, or the line in which the program refused.

    Args:
        seconds: processor time.
    """

    found: Diagnosis | None
    refused: str
    seconds: float

    @property
    def after(self) -> float:
        """Held-out error with everything found [mm]; NaN where it was refused."""
        return float("nan") if self.found is None else self.found.after.heldout_rms


def learn(paths: Sequence[Path]) -> Learnt:
    """Diagnoses one recording, or several of one arm together."""
    start = time.process_time()
    try:
        found = diagnose_file(paths[0]) if len(paths) == 1 else diagnose_together(paths)
    except TeachframeError as error:
        return Learnt(None, str(error), time.process_time() - start)
    return Learnt(found, "", time.process_time() - start)


def judged(learnt: Learnt, path: Path, aside: Sequence[int]) -> float:
    """Held-out error [mm] of the saved model on a run that it has not seen, base and tool fitted there.

    Args:
        aside: lines of that run that are not counted, the same as for the ordinary calibration.
    """
    if learnt.found is None:
        return float("nan")
    table = without(read_table(path), aside)
    try:
        steps = judge(table, robot_for(table), model_of(learnt.found)).steps
    except TeachframeError:
        return float("nan")
    return steps[WITH].heldout_rms


def without(table: Table, lines: Sequence[int]) -> Table:
    """The table without some lines of its file."""
    kept = ~np.isin(table.rows, np.asarray(lines, int))
    body, rows = table.body.filter(kept.tolist()), table.rows[kept]
    return replace(table, load=lambda: (body, rows))
