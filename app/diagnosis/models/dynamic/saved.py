"""A saved model on a log: the very function by which a model is judged, wherever it was learnt."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, as_given
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.samples import Samples, take
from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.observations.joint_log import Log
from app.kinematics import RobotModel


@dataclass(frozen=True, eq=False)
class Predicted:
    """A model beside a log.

    Args:
        samples: windows of the log under the model's hypothesis.
        parts: (effect number, (M, n)) torque that each effect adds, true of each joint [Nm].
        residual: (M, n) recorded torque less what the model predicts, in the columns of the file [Nm].
    """

    samples: Samples
    parts: tuple[tuple[int, np.ndarray], ...]
    residual: np.ndarray


def predict(log: Log, robot: RobotModel, motion: Motion, effects: Sequence[ModelEffect]) -> Predicted:
    """What a model predicts for a log, and what is left of its torques."""
    hypothesis = hypothesis_of(effects, robot.joint_count)
    samples = take(log, robot, motion, hypothesis)
    return beside(samples, effects)


def beside(samples: Samples, effects: Sequence[ModelEffect]) -> Predicted:
    """The same for windows that were taken under the effects' hypothesis already."""
    known, state, parts = laws(), samples.state, []
    total = samples.description
    for carried in (True, False):
        for k, effect in enumerate(effects):
            law = known.get(effect.effect)
            if law is None or law.undone or law.carried is not carried:
                continue
            added = _torque(state, effect, total.shape)
            parts.append((k, added))
            total = total + added
        state = state.with_torque(total, total)  # what the gears carry is known once masses and loads are in
    left = samples.state.hypothesis.recorded(samples.y - total)
    return Predicted(samples, tuple(parts), left)


def torque_of(samples: Samples, effects: Iterable[ModelEffect]) -> np.ndarray:
    """(M, n) torque of some effects of a model beside the description's [Nm]."""
    parts = beside(samples, list(effects)).parts
    return sum((part for _, part in parts), np.zeros_like(samples.y))


def _torque(state: State, effect: ModelEffect, shape: tuple[int, ...]) -> np.ndarray:
    out = np.zeros(shape)
    for joint, added in laws()[effect.effect].torque(state, effect.where, effect.parameters).items():
        out[:, joint] += added
    return out


def hypothesis_of(effects: Sequence[ModelEffect], joints: int) -> Hypothesis:
    """How a log is read that was recorded as the one the model was learnt from."""
    out, known = as_given(joints), laws()
    for effect in effects:
        if effect.effect in known:
            out = known[effect.effect].read_as(out, effect.where, effect.parameters)
    return out


def holding(model: SavedModel, rows: str) -> tuple[ModelEffect, ...]:
    """The model's effects that hold on a log with this fingerprint: events belong to the log they were found in."""
    if rows and rows == model.taught.rows:
        return tuple(model.effects)
    return tuple(e for e in model.effects if lasting(e))


def lasting(effect: ModelEffect) -> bool:
    """False for what happened once, in its own log."""
    law = laws().get(effect.effect)
    return "from_s" not in effect.where if law is None else law.lasts(effect.where)


def fingerprint(log: Log) -> str:
    """Of the rows that are used: times, positions and torques."""
    digest = hashlib.sha256()
    for values in (log.t, log.q, log.y):
        digest.update(np.round(np.ascontiguousarray(values), 9).tobytes())
    return digest.hexdigest()[:16]
