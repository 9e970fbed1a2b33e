"""The saved model of a fitted log: how it is read, what was given, every law of the selection."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.names import Member
from app.diagnosis.effects.dynamic._law import WIDTH, turn
from app.diagnosis.model import ModelEffect, Taught
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.saved import fingerprint, hypothesis_of
from app.diagnosis.result import Quality

if TYPE_CHECKING:
    from app.diagnosis.dynamic.fitting import Fitted


STILL = 1e-3  # rad or m: a joint whose range is less has not moved
POSES = 60  # kept of where a model was learnt


def readings(fitted: Fitted) -> tuple[ModelEffect, ...]:
    """Conventions of the log; mounting, delay and factors are in the selection, with their values."""
    return tuple(
        ModelEffect(trial.law.key, dict(trial.place.where), dict(trial.place.fixed))
        for trial in fitted.reading.taken
        if trial.law.whole_log
    )


def undone(fitted: Fitted, found: list[Member]) -> tuple[ModelEffect, ...]:
    """Mounting, delay and factors as the hypothesis holds them, beyond those of a model that was given."""
    now = fitted.study.state.hypothesis
    before = hypothesis_of(fitted.given, fitted.robot.joint_count)
    for m in found:
        if not m.held and m.candidate.law.undone:
            now = m.candidate.law.undo(now, m.candidate.place, m.values)
    named = {(m.candidate.law.key, int(m.candidate.place.where.get("joint", 0))) for m in found if m.named}
    return tuple(
        ModelEffect(law.key, dict(where), dict(values), named=(law.key, int(where.get("joint", 0))) in named)
        # what is of the arm first, then of the recording, then what scales it all
        for law in sorted(laws().values(), key=lambda law: (law.gain, not law.carried))
        for where, values in law.between(now, before)
    )


def undone_of(fitted: Fitted) -> tuple[ModelEffect, ...]:
    """How a log is read: conventions, mounting, delay, factors, none of them named."""
    return (*readings(fitted), *undone(fitted, []))


def given_effects(fitted: Fitted) -> tuple[ModelEffect, ...]:
    """Effects taken for part of the description; those of another log as this one moved them."""
    if fitted.prior is None:
        return fitted.given
    (g,) = [k for k in fitted.study.selection if fitted.study.label(k).law is fitted.prior]
    weights, _ = fitted.solution.of(fitted.study.group(g).columns)
    learnt = fitted.prior.effects()
    return (*(e for e in fitted.given if e not in learnt), *fitted.prior.effects(weights))


def effect_of(fitted: Fitted, member: Member) -> ModelEffect:
    law, place = member.candidate.law, member.candidate.place
    parameters = law.saved(place, member.values)
    if law.blunt and "joint" in place.where and WIDTH not in parameters:
        of = [int(place.where[k]) - 1 for k in ("joint", "source_joint") if k in place.where]
        parameters = {**parameters, **turn(fitted.study.state, *of)}
    return ModelEffect(law.key, dict(place.where), parameters, named=member.named)


def taught(fitted: Fitted, after: Quality) -> Taught:
    q = fitted.log.q
    low, high = q.min(axis=0), q.max(axis=0)
    some = np.unique(np.linspace(0, len(q) - 1, POSES).astype(int))
    return Taught(
        lowest=[float(v) for v in low], highest=[float(v) for v in high],
        still=[j + 1 for j in range(q.shape[1]) if high[j] - low[j] < STILL],
        poses=[[float(v) for v in row] for row in np.round(q[some], 4)],
        rows=fingerprint(fitted.log), heldout_rms=after.heldout_rms, unit=after.unit,
    )  # fmt: skip
