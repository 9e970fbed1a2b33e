"""A saved model on a log: the very function by which a model is judged, wherever it was learnt."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.effects.dynamic import wrong_convention
from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, as_given
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.samples import Samples, take
from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.observations.joint_log import Log
from app.kinematics import RobotModel

#: Laws that are part of how the log is read.
_READ = ("gravity_direction", "delay", "torque_constant", "wrong_convention")


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
            if law is None or effect.effect in _READ or law.carried is not carried:
                continue
            added = _torque(state, effect, total.shape)
            parts.append((k, added))
            total = total + added
        state = state.with_torque(total, total)  # what the gears carry is known once masses and loads are in
    left = samples.state.hypothesis.recorded(samples.y - total)
    return Predicted(samples, tuple(parts), left)


def _torque(state: State, effect: ModelEffect, shape: tuple[int, ...]) -> np.ndarray:
    out = np.zeros(shape)
    for joint, added in laws()[effect.effect].torque(state, effect.where, effect.parameters).items():
        out[:, joint] += added
    return out


def hypothesis_of(effects: Sequence[ModelEffect], joints: int) -> Hypothesis:
    """How a log is read that was recorded as the one the model was learnt from."""
    out = as_given(joints)
    for effect in effects:
        values = effect.parameters
        if effect.effect == "wrong_convention":
            out = wrong_convention.read(out, values)
        elif effect.effect == "gravity_direction":
            out = replace(out, gravity=np.array([values[k] for k in ("gx", "gy", "gz")]))
        elif effect.effect == "delay" and "joint" not in effect.where:
            out = replace(out, delay=out.delay + values["delay"])
        elif effect.effect == "torque_constant":
            factor = out.factors
            which = [int(effect.where["joint"]) - 1] if "joint" in effect.where else slice(None)
            factor[which] *= 1.0 + values["scale"]
            out = replace(out, factor=tuple(map(float, factor)))
    return out


def holding(model: SavedModel, rows: str) -> tuple[ModelEffect, ...]:
    """The model's effects that hold on a log with this fingerprint: events belong to the log they were found in."""
    if rows and rows == model.taught.rows:
        return tuple(model.effects)
    return tuple(e for e in model.effects if lasting(e))


def lasting(effect: ModelEffect) -> bool:
    """False for what happened once, in its own log."""
    law = laws().get(effect.effect)
    own_time = effect.effect == "smooth_torque" and effect.where.get("driver") == "time"
    return not own_time and (law is None or law.lasting) and "from_s" not in effect.where


def fingerprint(log: Log) -> str:
    """Of the rows that are used: times, positions and torques."""
    digest = hashlib.sha256()
    for values in (log.t, log.q, log.y):
        digest.update(np.round(np.ascontiguousarray(values), 9).tobytes())
    return digest.hexdigest()[:16]
