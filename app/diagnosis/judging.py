"""A model learnt on other recordings, judged on one it has not seen: the error before and after, nothing searched."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.result import Judged, Quality
from app.kinematics import RobotModel
from app.kinematics.dynamics import PER_LINK
from app.kinematics.robot import GRAVITY
from app.recordings import Table

if TYPE_CHECKING:
    from app.diagnosis.motion.log import Log
    from app.diagnosis.motion.sampling import Motion, Samples

BARE, WITH, MASSES = "description alone", "with the model", "with the model's masses only"


def judge(table: Table, robot: RobotModel, model: SavedModel, outliers: Sequence[int] = ()) -> Judged:
    """Error of the bare description and of the model.

    Static recordings: base, tool and targets are fitted in both, which every recording leaves open, and nothing
    else. Joint logs: nothing is fitted at all.

    Args:
        outliers: rows set aside in both (static).

    Raises:
        InputError, DegenerateGeometryError: the recording cannot be used.
    """
    steps = _motion(table, robot, model) if model.kind == "motion" else _static(table, robot, model, outliers)
    return Judged(model.source, steps)


def _static(
    table: Table, robot: RobotModel, model: SavedModel, outliers: Sequence[int]
) -> dict[str, Quality]:
    from app.diagnosis.static.findings import quality
    from app.diagnosis.static.models import held_terms, undone
    from app.diagnosis.static.plain import plain_fit
    from app.diagnosis.static.reading import read_static, renumbered

    recording = read_static(table, robot)
    kept = ~np.isin(recording.rows, np.asarray(outliers, int))
    if not kept.all():
        recording = renumbered(recording.subset(kept))
    told = undone(model, recording, robot)
    return {
        BARE: quality(plain_fit(recording, ())),
        WITH: quality(plain_fit(told, held_terms(model, told.situation, told.file))),
    }


def _motion(table: Table, robot: RobotModel, model: SavedModel) -> dict[str, Quality]:
    from app.diagnosis.motion.engine import ready

    log, motion, _ = ready(table, robot)
    samples, residuals = torque_residuals(log, robot, motion, model)
    return {what: _torque(r, samples.usable) for what, r in residuals.items()}


def torque_residuals(
    log: Log, robot: RobotModel, motion: Motion, model: SavedModel
) -> tuple[Samples, dict[str, np.ndarray]]:
    """The log's samples, and what is in the simulation -> (M, n) torque beyond it [Nm], the bare description first.

    Late torques, wrong factors and a leaning base are undone in the samples before the model is compared with
    them, as the diagnosis does.
    """
    from app.diagnosis.motion.library import laws
    from app.diagnosis.motion.sampling import take_samples

    bare = told = take_samples(log, robot, motion, log.y, lambda share, what: None)
    steps = {BARE: bare.y}
    corrected = [e for e in model.effects if e.effect in laws() and laws()[e.effect].corrected]
    if corrected:
        delay, scale, gravity = _undone(corrected, robot.joint_count)
        told = take_samples(
            log, robot, motion, log.y / (1.0 + scale), lambda share, what: None, shift=delay, gravity=gravity
        )
    residual = told.y.copy()
    masses = np.array(model.nuisance.get("inertial", ()), float)
    if len(masses) == PER_LINK * robot.joint_count:
        for j in range(robot.joint_count):
            residual[:, j] -= told.regressor[:, :, j] @ masses
        steps[MASSES] = bare.y - np.einsum("mkj,k->mj", bare.regressor, masses)
    for effect in model.effects:
        law = laws().get(effect.effect)
        if law is None or law.corrected or not _lasting(effect):
            continue
        added = told.pool(law.apply(told.state, effect.where, effect.parameters))
        if added.ndim == 1:
            residual[:, int(effect.where["joint"]) - 1] -= added
        else:
            residual -= added
    return bare, {**steps, WITH: residual}


def _undone(effects: Sequence[ModelEffect], joints: int) -> tuple[float, np.ndarray, np.ndarray]:
    """Delay [s], relative excess of each torque (n,), and gravity (3,) [m/s^2]."""
    delay, scale, gravity = 0.0, np.zeros(joints), GRAVITY.copy()
    for effect in effects:
        values = effect.parameters
        if effect.effect == "delay" and "joint" not in effect.where:
            delay += values["delay"]
        elif effect.effect == "torque_constant" and "joint" in effect.where:
            scale[int(effect.where["joint"]) - 1] += values["scale"]
        elif effect.effect == "gravity_direction":
            gravity = np.array([values[k] for k in ("gx", "gy", "gz")])
    return delay, scale, gravity


def _lasting(effect: ModelEffect) -> bool:
    """A contact or a load taken up belongs to the log it was found in."""
    return "from_s" not in effect.where


def _torque(residual: np.ndarray, usable: np.ndarray) -> Quality:
    rms = float(np.sqrt(np.mean(residual[usable] ** 2))) if usable.any() else float("nan")
    return Quality(rms, rms, "Nm")
