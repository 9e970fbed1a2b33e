"""The whole: a table in, a diagnosis out."""

from __future__ import annotations

import time as clock
from dataclasses import replace

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.result import Diagnosis, Progress
from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.gross import Rewritten, rewritten
from app.diagnosis.static.models import held_terms, undone
from app.diagnosis.static.outcome import Outcome
from app.diagnosis.static.plain import plain_fit
from app.diagnosis.static.plan import explore
from app.diagnosis.static.reading import read_static, renumbered
from app.diagnosis.static.recording import StaticRecording
from app.diagnosis.static.robust import outlier_rows
from app.diagnosis.static.verdict import conclude
from app.kinematics import RobotModel
from app.recordings import Table

#: Rows, and share of all rows, set aside from which on they are looked at as a sign of something.
FEW, MANY = 3, 0.05


def diagnose(
    table: Table,
    robot: RobotModel,
    *,
    progress: Progress | None = None,
    seed: int = 0,
    model: SavedModel | None = None,
) -> Diagnosis:
    """Where a touch or tracker recording differs from the robot's description, and what it is.

    Args:
        progress: called with the share done; may raise Cancelled.
        seed: of the sign flips.
        model: effects known already; they are applied first.

    Raises:
        InputError, DegenerateGeometryError: the recording cannot be used.
    """
    began = clock.perf_counter()
    tick = progress or (lambda share, what: None)
    tick(0.0, "reading")
    recording = read_static(table, robot)
    known = ()
    if model is not None:
        recording = undone(model, recording, robot)
        known = held_terms(model, recording.situation, recording.file)
    tick(0.05, "fitting base and tool")
    written = rewritten(recording, robot, known)
    outcome = search(written, known, seed, tick)
    diagnosis = conclude(robot, outcome, tick, began)
    tick(1.0, "done")
    return diagnosis


def everywhere(recording: StaticRecording, fitted: Fitted) -> Fitted:
    """The same model held against every row, outliers included."""
    weights = recording.present * fitted.weights.max(axis=0)

    def held(terms: tuple[Term, ...]) -> Fitted:
        return fit(recording, fitted.setup, terms, weights, held=fitted.held, iterations=0)

    best = held(fitted.terms)
    for index, term in enumerate(fitted.terms):
        # Rows set aside just before a step may well be those with which it began.
        for row in _before(recording, fitted, term):
            earlier = replace(term, place=replace(term.place, where={**term.where, "from_row": row}))
            trial = held((*best.terms[:index], earlier, *best.terms[index + 1 :]))
            best = trial if trial.rss < best.rss else best
    return best


def _before(recording: StaticRecording, fitted: Fitted, term: Term) -> list[int]:
    """Rows that were set aside between a step's first row and the last one kept before it."""
    if "from_row" not in term.where:
        return []
    begins = int(term.where["from_row"])
    kept, rows = fitted.recording.situation.order, recording.situation.order
    last = kept[kept < begins].max(initial=-1)
    return [int(row) for row in rows[(rows > last) & (rows < begins)]]


def search(written: Rewritten, held, seed: int, tick) -> Outcome:
    """Robust forward search: outliers are judged with the base fit, and again with what was found.

    What happens late in a recording makes its rows look like outliers to a fit without it, and is lost with them.
    So where many were set aside and nothing was found, all rows are looked at together; what makes most of them
    belong again stands.
    """
    rng = np.random.default_rng(seed)
    first = outlier_rows(written.plain)
    outcome = _search(written, held, first, rng, tick)
    aside = int(outcome.outliers.sum())
    if aside < max(FEW, MANY * written.recording.size) or _named(outcome):
        return outcome
    whole = _search(written, held, np.zeros_like(first), rng, tick)
    return whole if _named(whole) and 2 * whole.outliers.sum() <= aside else outcome


def _named(outcome: Outcome) -> bool:
    return any(not term.tacit for term in outcome.plan.found.fitted.terms)


def _search(written: Rewritten, held, out: np.ndarray, rng: np.random.Generator, tick) -> Outcome:
    """Twice at most: without the rows `out`, and without those that do not belong to what was found."""
    recording = written.recording
    kept = np.ones(recording.size, bool)
    before = written.plain
    plan = None
    for _ in range(2):
        kept = ~out
        before = written.plain if kept.all() else plain_fit(renumbered(recording.subset(kept)), held)
        plan = explore(before, rng, tick)
        fitted = plan.found.fitted
        whole_setup = fitted.recording.target_names == recording.target_names
        if not fitted.terms or not whole_setup or len(fitted.setup.rotations) != recording.session_count:
            break
        whole = everywhere(recording, fitted)
        again = outlier_rows(whole)
        if np.array_equal(again, out):
            break
        out = again
    assert plan is not None
    return Outcome(written, before, plan, ~kept)
