"""The result: findings with uncertainty, residuals before and after, what pictures are drawn from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.motion.alternatives import alternatives_of
from app.diagnosis.motion.commands import lag_findings
from app.diagnosis.motion.confirmed import confirmed
from app.diagnosis.motion.errors import ErrorTable
from app.diagnosis.motion.next_motion import next_motion
from app.diagnosis.motion.sampling import Samples
from app.diagnosis.motion.uncertainty import widening
from app.diagnosis.result import Diagnosis, Evidence, Finding, Leftover, Noise, Parameter, Quality
from app.diagnosis.wording import note
from app.kinematics import RobotModel
from app.kinematics.robot import GRAVITY

if TYPE_CHECKING:
    from app.diagnosis.motion.study import Study


def build(study: Study, robot: RobotModel, file: str) -> Diagnosis:
    """Everything said of one log."""
    fit, judgement, samples = study.fit, study.judgement, study.samples
    table = ErrorTable(
        study.system, study.prior, [t.group for t in fit.terms], samples.y - fit.offset, study.done
    )
    base = list(range(study.known))
    named = [i for i, good in enumerate(judgement.named) if good]
    widened = widening(study.system, fit.solution, study.prior)
    by_term = {i: _finding(study, table, i, base + named, widened) for i in named}
    masses, effects = confirmed(study, robot, table, by_term)
    order = sorted(named, key=lambda i: -judgement.gains[i])
    late = lag_findings(study.log, samples.state.sliding)
    findings = [*(by_term[i] for i in order), *late]
    poses, advice = next_motion(study, robot, tuple(findings))
    after_residual = table.residual(base + named)
    after = _quality(samples, after_residual, table.heldout(base + named))
    before = _quality(samples, study.before_residual, study.before_heldout)
    leftover = Leftover(judgement.leftover_p, judgement.leftover_where)
    structure = judgement.leftover_p <= 0.01 or not all(judgement.named[study.known :])
    if findings:
        verdict = "partly" if structure else "named"
    else:
        verdict = "unexplained" if structure else "clean"
    if verdict == "clean":
        leftover = Leftover(judgement.leftover_p, {})
    recorded = 1.0 + study.corrections.scale  # the samples are in the torque that was meant
    spreads = [w.spread * k for w, k in zip(study.system.whiteners, recorded, strict=True) if w.weight.any()]
    spread = float(np.sqrt(np.mean(np.square(spreads))))
    log = study.log
    if samples.repeat:
        noise = Noise(float(spread * np.sqrt(samples.window)), "Nm", "repeats")
    elif log.stated_noise is not None:
        noise = Noise(float(np.sqrt(np.mean(log.stated_noise**2))), "Nm", "stated")
    else:
        noise = Noise(float(spread * np.sqrt(samples.window)), "Nm", "residual")
    state = samples.state
    n = robot.joint_count
    drivers = {"time [s]": samples.t}
    for j in range(n):
        drivers[f"q{j + 1} [rad]"] = samples.pool(state.q[:, j])
        drivers[f"qd{j + 1} [rad/s]"] = samples.pool(state.qd[:, j])
        drivers[f"qdd{j + 1} [rad/s^2]"] = samples.pool(state.qdd[:, j])
        drivers[f"gravity torque {j + 1} [Nm]"] = samples.pool(state.gravity_torque[:, j])
        if state.temperature is not None:
            drivers[f"temperature {j + 1} [degC]"] = samples.pool(state.temperature[:, j])
    measured = samples.y + samples.pool(state.torque)
    evidence = Evidence(
        rows=log.rows[samples.centre], measured=measured, before=study.before_residual, after=after_residual,
        components=tuple(f"joint {j + 1}" for j in range(n)), unit="Nm", q=samples.pool(state.q),
        drivers=drivers, kept=np.asarray(samples.usable.any(axis=1)),
    )  # fmt: skip
    model = SavedModel(
        "motion",
        robot.name,
        (*(effects[i] for i in order), *(_as_effect(f) for f in late)),
        {"inertial": [float(v) for v in masses]},
        file,
    )
    return Diagnosis(
        file=file, kind="motion", robot=robot.name, samples=len(log.t), verdict=verdict, noise=noise,
        before=before, after=after, findings=tuple(findings),
        outliers=tuple(int(r) for r in log.dropped), leftover=leftover, next_poses=poses, seconds=0.0,
        notes=(*_notes(study), *advice), model=model.to_dict(), evidence=evidence,
    )  # fmt: skip


def _as_effect(finding: Finding) -> ModelEffect:
    return ModelEffect(finding.effect, dict(finding.where), {p.name: p.value for p in finding.parameters})


def _finding(study: Study, table: ErrorTable, index: int, named: list[int], widened: np.ndarray) -> Finding:
    fit, term = study.fit, study.fit.terms[index]
    law, group = term.group.law, term.group
    assert law is not None
    values, std = dict(fit.values[index]), fit.spreads(index, widened)
    if law.key == "delay":
        values["delay"] += study.corrections.delay
    if law.key == "gravity_direction":
        done = study.corrections.gravity - GRAVITY
        values = {k: v + d for (k, v), d in zip(values.items(), done, strict=True)}
    if law.key == "torque_constant" and group.joint is not None:
        done = study.corrections.scale[group.joint]
        values["scale"] = (1 + done) * (1 + values["scale"]) - 1
        std = std * (1 + done)
    parameters = tuple(
        Parameter(name, float(value), float(s), law.units.get(name, ""))
        for (name, value), s in zip(values.items(), std, strict=True)
    )
    where = {k: (round(v, 4) if isinstance(v, float) else v) for k, v in group.where.items()}
    others = [i for i in named if i != index]
    return Finding(
        effect=law.key,
        where=where,
        parameters=parameters,
        visible=term.visible,
        p_value=study.judgement.p_values[index],
        heldout_rms_without=_a_sample(study.samples, table.heldout(others)),
        heldout_rms_with=_a_sample(study.samples, table.heldout(named)),
        alternatives=alternatives_of(study, index),
        sentence=law.explain(where, values),
        equation=law.equation,
    )


def _quality(samples: Samples, residual: np.ndarray, heldout: float) -> Quality:
    """Errors of one sample as it was recorded, not of a window's mean."""
    usable = samples.usable
    fitted = float(np.sqrt(np.mean(residual[usable] ** 2))) if usable.any() else float("nan")
    return Quality(_a_sample(samples, fitted), _a_sample(samples, heldout), "Nm")


def _a_sample(samples: Samples, rms: float) -> float:
    return float(np.sqrt(rms**2 + np.mean(samples.within)))


def _notes(study: Study) -> tuple[str, ...]:
    samples, log = study.samples, study.log
    notes = [*log.notes, *study.notes, samples.smoothing.sentence()]
    if samples.repeat:
        again = samples.repeat * samples.step
        notes.append(note("repeat", seconds=again))
    if samples.thinned:
        notes.append(
            note("thinned", used=len(samples.t) * samples.window, total=len(log.t), window=samples.window)
        )
    elif samples.window > 1:
        notes.append(note("averaged", window=samples.window))
    if study.prior_scale > 1:
        notes.append(note("prior_widened", times=study.prior_scale))
    lags = [len(w.lags) for w in study.system.whiteners]
    if max(lags):
        notes.append(note("coloured", orders=tuple(lags)))
    return (*notes, *study.judgement.reasons)
