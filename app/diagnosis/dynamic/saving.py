"""The saved model of a fitted log: how it is read, what was given, every law of the selection."""

from __future__ import annotations

import numpy as np

from app.diagnosis.dynamic.fitting import Fitted
from app.diagnosis.dynamic.names import Member
from app.diagnosis.effects.dynamic._friction import WIDTH
from app.diagnosis.model import ModelEffect, Taught
from app.diagnosis.models.dynamic.saved import fingerprint, hypothesis_of
from app.diagnosis.result import Quality

STILL = 1e-3  # rad or m: a joint whose range is less has not moved
POSES = 60  # kept of where a model was learnt


def readings(fitted: Fitted) -> tuple[ModelEffect, ...]:
    """Conventions of the log; mounting, delay and factors are in the selection, with their values."""
    return tuple(
        ModelEffect(key, dict(place.where), dict(place.fixed))
        for key, place in fitted.reading.places
        if key == "wrong_convention"
    )


def undone(fitted: Fitted, found: list[Member]) -> tuple[ModelEffect, ...]:
    """Mounting, delay and factors as the hypothesis holds them, beyond those of a model that was given."""
    now, n = fitted.study.state.hypothesis, fitted.robot.joint_count
    before = hypothesis_of(fitted.given, n)
    named = {(m.candidate.law.key, int(m.candidate.place.where.get("joint", 0))) for m in found if m.named}
    out: list[ModelEffect] = []

    def add(key: str, where: dict, parameters: dict[str, float]) -> None:
        out.append(ModelEffect(key, where, parameters, named=(key, int(where.get("joint", 0))) in named))

    if np.any(now.gravity) and not np.allclose(now.gravity, before.gravity):
        g: dict[str, float] = dict(zip(("gx", "gy", "gz"), map(float, now.gravity), strict=True))
        add("gravity_direction", {"body": "base", "driver": "gravity_torque"}, g)
    if now.delay != before.delay:
        add("delay", {"driver": "time"}, {"delay": now.delay - before.delay})
    factors = now.factors / before.factors
    for m in found:
        if not m.held and m.candidate.law.undone:
            factors[int(m.candidate.place.where["joint"]) - 1] *= 1.0 + float(m.values[0])
    scale = factors - 1.0
    if n > 1 and np.allclose(scale, scale[0], rtol=1e-9) and scale[0]:
        add("torque_constant", {}, {"scale": float(scale[0])})
    else:
        for j in np.flatnonzero(scale):
            add("torque_constant", {"joint": int(j) + 1}, {"scale": float(scale[j])})
    return tuple(out)


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
        joint = int(place.where["joint"]) - 1
        width = float(fitted.study.state.width[joint])
        if "source_joint" in place.where:
            width = float(np.mean([width, fitted.study.state.width[int(place.where["source_joint"]) - 1]]))
        parameters = {**parameters, WIDTH: width}
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
