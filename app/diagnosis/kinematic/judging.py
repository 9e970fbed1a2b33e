"""A model on a recording: base, tool and touched points fitted, nothing else. The one source of every error said.

The diagnosis itself takes its "before" and "after" from here, from the model that it saves; so what is said once
is what the saved file gives again.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.kinematic.plain import plain_state
from app.diagnosis.model import SavedModel
from app.diagnosis.models.kinematic.saved import fingerprint, held_terms, undone
from app.diagnosis.models.kinematic.state import State, columns_of, free_columns, settled, started
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.regression.heldout import folds_of, heldout_residuals
from app.diagnosis.result import Quality
from app.diagnosis.thresholds.rows import OUTLIER_WEIGHT
from app.kinematics import RobotModel
from app.units import mm


@dataclass(frozen=True, eq=False)
class Judgement:
    """A recording seen by the bare description and by a model.

    Args:
        kept: (m,) False for rows that do not belong even to the model; they count in neither.
        before, after: base, tool and touched points fitted by least squares to the rows kept.
        before_quality, after_quality: their errors.
        own: True where these are the rows the model was learnt from.
    """

    kept: np.ndarray
    before: State
    after: State
    before_quality: Quality
    after_quality: Quality
    own: bool


def judged(
    recording: StaticRecording, robot: RobotModel, model: SavedModel, known: SavedModel | None = None
) -> Judgement:
    """The errors of the bare description and of a model on the same rows.

    Args:
        known: a model that is part of the description already; None for the description as it is.

    Raises:
        InputError, DegenerateGeometryError: the recording cannot be used.
    """
    told = undone(model, recording, robot).by_points()
    recording = recording.by_points()
    rows = fingerprint(recording)
    terms = held_terms(model, told.situation, rows)
    robust, weight = plain_state(told, terms)
    kept = weight > OUTLIER_WEIGHT
    after = _least_squares(robust, kept)
    before = _least_squares(_described(recording, robot, known, told, robust), kept)
    own = bool(model.taught.rows) and rows == model.taught.rows
    quality = quality_of(after, kept)
    if own and model.taught.heldout_rms > 0:
        # The rows taught the model: leaving some out of the set-up alone would hold nothing out.
        quality = replace(quality, heldout_rms=model.taught.heldout_rms)
    return Judgement(kept, before, after, quality_of(before, kept), quality, own)


def bare(recording: StaticRecording) -> Judgement:
    """The bare description alone, every row that belongs to it kept."""
    robust, weight = plain_state(recording, ())
    kept = weight > OUTLIER_WEIGHT
    state = _least_squares(robust, kept)
    quality = quality_of(state, kept)
    return Judgement(kept, state, state, quality, quality, False)


def _described(
    recording: StaticRecording,
    robot: RobotModel,
    known: SavedModel | None,
    told: StaticRecording,
    robust: State,
) -> State:
    """A state of the description, with what is known of it already."""
    if known is not None:
        as_known = undone(known, recording, robot)
        return plain_state(as_known, held_terms(known, as_known.situation, fingerprint(recording)))[0]
    if told.q is recording.q:
        return settled(started(recording, (), robust.weights))
    return plain_state(recording, ())[0]


def _least_squares(state: State, kept: np.ndarray) -> State:
    """Base, tool and touched points by plain least squares on the rows kept."""
    largest = state.weights.max(axis=0, initial=0.0)
    weights = state.recording.present * largest * kept[:, None]
    weights = np.where(kept[:, None], weights, state.recording.present * largest * 1e-6)
    return settled(replace(state, weights=weights))


def quality_of(state: State, kept: np.ndarray) -> Quality:
    """Fit and held-out error of the position components [mm] over the rows kept."""
    recording = state.recording
    counted = recording.present & ~recording.angular & kept[:, None]
    free, absorbed = free_columns(state, columns_of(state))
    fold = np.repeat(folds_of(recording.pose), state.weights.shape[1])
    none = np.zeros(free.shape[1])
    (left,) = heldout_residuals(free, state.white, none, fold, [len(none)], absorbed)
    scale = np.where(state.weights > 0, state.weights, 1.0).reshape(-1)
    held = (left / scale).reshape(state.weights.shape)[counted]
    held = held[np.isfinite(held)]
    fit = float(np.sqrt(np.mean(state.residual[counted] ** 2))) if counted.any() else 0.0
    return Quality(mm(fit), mm(float(np.sqrt(np.mean(held**2)))) if held.size else mm(fit), "mm")
