"""The order of the diagnosis of a joint log, from the table to the findings."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from app.diagnosis.dynamic.conventions import Reading, reading_of
from app.diagnosis.dynamic.findings import build
from app.diagnosis.dynamic.fitting import Fitted, fit
from app.diagnosis.dynamic.joining import in_order, joined
from app.diagnosis.dynamic.ready import ready, trust_of
from app.diagnosis.dynamic.reference import known_from
from app.diagnosis.dynamic.saving import undone_of
from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.saved import hypothesis_of
from app.diagnosis.result import Diagnosis, Progress
from app.diagnosis.thresholds.naming_logs import CHANGE
from app.kinematics import RobotModel
from app.recordings import Table
from app.steps import listened


def diagnose(
    table: Table,
    robot: RobotModel,
    *,
    reference: Table | None = None,
    progress: Progress | None = None,
    seed: int = 0,
    model: SavedModel | None = None,
) -> Diagnosis:
    """Where a joint log and the rigid-body description differ, by what law, and how the fit improves.

    Args:
        table: a motion recording.
        reference: a run of the same arm in a known good state; only what changed since is then named.
        progress: told how far it is; may raise Cancelled.
        seed: kept for the common signature; nothing is drawn at random.
        model: effects found before, taken as part of the robot.

    Raises:
        InputError: the recording cannot be used; names file, row and column.
    """
    started = time.perf_counter()
    tell = progress or (lambda share, what: None)
    options: dict[str, Any]
    tell(0.0, "reading")
    stretch: dict[str, float] = trust_of(table)
    with listened(lambda share, what: tell(0.1 * share, what), "reading"):
        log, motion, without = ready(table, robot)
    first: tuple[str, ...] = ()
    single: frozenset[str] = frozenset()
    given = tuple(model.effects) if model is not None else ()
    prior = known = None
    if reference is not None:
        known = _fitted(
            reference, robot, trust_of(reference), given, lambda share, what: tell(0.4 * share, what)
        )
        prior = known_from(known)
        given = (*undone_of(known), *prior.effects())
        known_laws = laws()
        stretch |= {key: law.between_logs for key, law in known_laws.items() if law.between_logs != 1.0}
        first = tuple(key for key, law in known_laws.items() if law.likely)
        single = frozenset(key for key, law in known_laws.items() if law.one_place)
    tell(0.45 if reference is not None else 0.1, "mounting, senses, units")
    reading = (
        reading_of(log, robot, motion)
        if reference is None
        else Reading(hypothesis_of(given, robot.joint_count))
    )
    options = {"stretch": stretch, "given": given, "prior": prior, "first": first, "single": single}
    asks_reading = (
        frozenset(key for key, law in laws().items() if law.undone) if prior is not None else frozenset()
    )
    fitted = fit(log, robot, motion, reading, tell, without=without | asks_reading, **options)
    if prior is not None and fitted.left.any():  # is one of the two read otherwise: later, leaning, scaled?
        other = fit(log, robot, motion, reading, tell, without=without, **options)
        fitted = other if other.error < (1.0 - CHANGE) * fitted.error else fitted
    tell(0.85, "names")
    out = build(fitted, str(table.path), reference=known)
    tell(1.0, "done")
    return replace(out, seconds=time.perf_counter() - started)


def diagnose_together(
    tables: Sequence[Table],
    robot: RobotModel,
    *,
    progress: Progress | None = None,
    model: SavedModel | None = None,
) -> Diagnosis:
    """Several logs of one arm as one, one after the other in time: masses, friction and gains are shared.

    The model it saves is what all of them taught.

    Raises:
        InputError: one of them cannot be used.
    """
    started = time.perf_counter()
    tell = progress or (lambda share, what: None)
    tell(0.0, "reading")
    logs = [ready(table, robot) for table in tables]
    order = in_order(logs)
    log, motion, without = joined([logs[k] for k in order])
    tell(0.1, "mounting, senses, units")
    reading = reading_of(log, robot, motion)
    stretch = min((trust_of(table) for table in tables), key=lambda trust: tuple(trust.values()))
    given = tuple(model.effects) if model is not None else ()
    fitted = fit(log, robot, motion, reading, tell, without=without, stretch=stretch, given=given)
    out = build(fitted, " + ".join(Path(tables[k].path).name for k in order))
    tell(1.0, "done")
    return replace(out, seconds=time.perf_counter() - started)


def _fitted(
    table: Table, robot: RobotModel, stretch: dict[str, float], given: Sequence[ModelEffect], tell: Progress
) -> Fitted:
    """A log with its laws."""
    log, motion, without = ready(table, robot)
    reading = reading_of(log, robot, motion)
    return fit(log, robot, motion, reading, tell, without=without, stretch=stretch, given=given)
