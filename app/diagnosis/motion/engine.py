"""The order of a motion diagnosis, from the table to the findings."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.motion.baseline import baseline_of
from app.diagnosis.motion.findings import build
from app.diagnosis.motion.gains import estimated_gains
from app.diagnosis.motion.log import Log, read_log
from app.diagnosis.motion.prior import MASS
from app.diagnosis.motion.sampling import Motion, motion_of
from app.diagnosis.motion.study import Given, examine
from app.diagnosis.motion.suspects import HOPELESS, check_columns
from app.diagnosis.result import Diagnosis, Progress
from app.diagnosis.wording import note
from app.errors import CellValueError
from app.kinematics import RobotModel
from app.recordings import Table


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
        seed: of the null's sign flips.
        model: effects found before, taken as part of the robot.

    Raises:
        InputError: the recording cannot be used; names file, row and column.
    """
    started = time.perf_counter()
    tell = progress or (lambda share, what: None)
    tell(0.0, "reading")
    given = Given(effects=model.effects if model else (), mass_prior=_mass_prior(table))
    if reference is not None:
        known, motion, without = ready(reference, robot)
        study = examine(known, robot, motion, lambda share, what: tell(0.4 * share, what), seed, given)
        given = replace(given, base=baseline_of(study), without=without)
    log, motion, without = ready(table, robot)
    given = replace(given, without=given.without | without)
    study = examine(log, robot, motion, tell, seed, given)
    tell(0.95, "report")
    out = build(study, robot, str(table.path))
    tell(1.0, "done")
    return replace(out, seconds=time.perf_counter() - started)


def ready(table: Table, robot: RobotModel) -> tuple[Log, Motion, frozenset[str]]:
    """The log in newton-metres, its motion, and effects it cannot tell."""
    log = read_log(table, robot)
    motion = motion_of(log)
    without: frozenset[str] = frozenset()
    if log.current:
        gains, sigmas = estimated_gains(log, robot, motion[:3], table)
        said = tuple(f"{g:.3g} ± {s:.2g}" for g, s in zip(gains, sigmas, strict=True))
        log = replace(
            log, y=log.y * gains, current=False, notes=(*log.notes, note("gains_estimated", gains=said))
        )
        without = frozenset({"torque_constant"})
    if check_columns(log, robot, motion[:3], log.y, table) > HOPELESS:
        log = replace(log, foreign=True)
    return log, motion, without


def _mass_prior(table: Table) -> float:
    """How far the header says the links' masses may be off, relative.

    Raises:
        CellValueError: it says something else than a positive number.
    """
    stated = table.keys.get("inertial_prior")
    if stated is None:
        return MASS
    if (
        isinstance(stated, bool)
        or not isinstance(stated, int | float)
        or not (np.isfinite(stated) and stated > 0)
    ):
        raise CellValueError(
            f"found {str(stated)[:40]!r}",
            file=table.path,
            column="inertial_prior",
            expected="a positive share, such as 0.05",
        )
    return float(stated)
