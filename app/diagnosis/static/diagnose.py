"""The whole: a table in, a diagnosis out."""

from __future__ import annotations

import time as clock

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.result import Diagnosis, Progress
from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.models import held_terms
from app.diagnosis.static.noise import starting_weights, weights_from
from app.diagnosis.static.nuisance import starting_setup
from app.diagnosis.static.plan import Plan, explore
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
    known = () if model is None else held_terms(model, recording.situation)
    tick(0.05, "fitting base and tool")
    outcome = search(recording, known, seed, tick)
    diagnosis = conclude(recording, robot, outcome, known, seed, tick, clock.perf_counter() - began)
    tick(1.0, "done")
    return diagnosis


def plain_fit(recording: StaticRecording, held: tuple[Term, ...]) -> Fitted:
    """Base, tool and targets only."""
    from app.diagnosis.static.cell import pose
    from app.diagnosis.static.fit import apply_terms

    situation = recording.situation
    cell = apply_terms(situation, held)
    posed = pose(situation, cell, np.zeros((recording.reflectors, 3)))
    setup = starting_setup(recording, posed.hand, posed.frames.flange_positions)
    first = fit(recording, setup, (), starting_weights(recording), held=held, iterations=30)
    return fit(recording, first.setup, (), weights_from(first), held=held)


def everywhere(recording: StaticRecording, fitted: Fitted) -> Fitted:
    """The same model fitted to every row, outliers included."""
    weights = recording.present * fitted.weights.max(axis=0)
    return fit(recording, fitted.setup, fitted.terms, weights, held=fitted.held, iterations=0)


class Outcome:
    """What the search leaves: the plain fit before, the findings, and the rows set aside."""

    def __init__(self, before: Fitted, plan: Plan, outliers: np.ndarray):
        self.before, self.plan, self.outliers = before, plan, outliers
        self.found = plan.found


def search(recording: StaticRecording, held, seed: int, tick) -> Outcome:
    """Robust forward search: outliers are judged with the base fit, and again with what was found."""
    rng = np.random.default_rng(seed)
    kept = np.ones(recording.size, bool)
    before = plain_fit(recording, held)
    out = outlier_rows(before)
    plan = None
    for _ in range(2):
        kept = ~out
        part = recording if kept.all() else renumbered(recording.subset(kept))
        before = plain_fit(part, held)
        plan = explore(before, rng, tick)
        fitted = plan.found.fitted
        if not fitted.terms or len(fitted.setup.rotations) != recording.session_count:
            break
        whole = everywhere(recording, fitted)
        again = outlier_rows(whole)
        if np.array_equal(again, out):
            break
        out = again
    assert plan is not None
    return Outcome(before, plan, ~kept)
