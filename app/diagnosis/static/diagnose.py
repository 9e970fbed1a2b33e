"""The whole: a table in, a diagnosis out."""

from __future__ import annotations

import time as clock

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.result import Diagnosis, Progress
from app.diagnosis.static.fit import Fitted, fit
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
    """The same model fitted to every row, outliers included."""
    weights = recording.present * fitted.weights.max(axis=0)
    return fit(recording, fitted.setup, fitted.terms, weights, held=fitted.held, iterations=0)


def search(written: Rewritten, held, seed: int, tick) -> Outcome:
    """Robust forward search: outliers are judged with the base fit, and again with what was found."""
    rng = np.random.default_rng(seed)
    recording = written.recording
    kept = np.ones(recording.size, bool)
    before = written.plain
    out = outlier_rows(before)
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
