"""The result: findings with uncertainty, the saved model, residuals before and after, what pictures are drawn from."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.budget import budget
from app.diagnosis.dynamic.loads import told_as_load
from app.diagnosis.dynamic.names import Member, differs, members, rivals, waves
from app.diagnosis.dynamic.next_motion import next_motion
from app.diagnosis.dynamic.pictures import evidence_of
from app.diagnosis.dynamic.saving import effect_of, given_effects, readings, taught, undone
from app.diagnosis.dynamic.shapes import spread_of
from app.diagnosis.dynamic.solution import error_with, heldout_without, surprise
from app.diagnosis.dynamic.withheld import withheld
from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.models.dynamic.both_sides import twist_findings
from app.diagnosis.models.dynamic.commands import lag_findings
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.repeats import noise_of_repeats
from app.diagnosis.models.dynamic.saved import beside, hypothesis_of, torque_of
from app.diagnosis.result import (
    UNNAMED,
    Alternative,
    Diagnosis,
    FamilyShare,
    Finding,
    Leftover,
    Noise,
    Quality,
)
from app.diagnosis.thresholds.naming import CERTAIN, UNNAMED_SHARE
from app.diagnosis.thresholds.naming_logs import CHANGE, HOPELESS, INCOMPLETE, NAME, RIPPLES
from app.diagnosis.thresholds.noise import LEFT_P
from app.diagnosis.wording import note

if TYPE_CHECKING:
    from app.diagnosis.dynamic.fitting import Fitted


def build(fitted: Fitted, file: str, *, reference: Fitted | None = None) -> Diagnosis:
    """Everything said of one log; against a reference only what changed."""
    log, robot, study = fitted.log, fitted.robot, fitted.study
    bare = fitted.take(as_given(robot.joint_count))
    before = bare.y - bare.description
    noise = _noise(fitted)
    complete = not fitted.left.any() and fitted.error**2 <= INCOMPLETE * noise.value**2
    found = [
        told_as_load(study, m, study.samples.nominal, complete)
        for m in members(
            study, fitted.solution, fitted.loose, before, noise.value**2 / study.samples.window, fitted.left
        )
    ]
    read = readings(fitted)
    effects = (*given_effects(fitted), *read, *undone(fitted, found))
    effects = (*effects, *(effect_of(fitted, m) for m in found if not m.candidate.law.undone))
    whole = beside(fitted.take(hypothesis_of(effects, robot.joint_count)), effects)
    heldout = study.state.hypothesis.recorded(fitted.solution.heldout)
    used = study.samples.used
    quality_before = _quality(bare.within, before, before, used)
    quality_after = _quality(study.samples.within, whole.residual, heldout, used)
    named = sorted((m for m in found if m.named), key=lambda m: -m.share)
    if reference is not None:
        named = [
            m for m in named if m.held or (_changes(fitted, m, quality_after) and differs(reference.asked, m))
        ]
    late = (*_lags(fitted, named), *(twist_findings(study.state) if reference is None else ()))
    take_as = lambda h: study.samples if h is study.state.hypothesis else fitted.take(h)  # noqa: E731
    findings = (
        *_reading_findings(fitted, quality_before, quality_after),
        *(
            _finding(fitted, m, quality_after, lambda m: _without(fitted, effects, found, m, take_as))
            for m in named
        ),
        *late,
    )
    families = budget(
        fitted,
        effects,
        whole,
        before,
        noise.value**2 / study.samples.window,
        take_as,
        found,
        quality_after,
        undone(fitted, []),
    )
    poses, advice = next_motion(fitted, named) if findings else ((), ())
    families = _with_members(families, findings)
    unnamed = sum(m.share for m in found if m.candidate.law.family == UNNAMED)
    left = fitted.left
    shaped = [j for j, count in waves(study).items() if count > RIPPLES]
    mismatch = float(np.mean(before**2)) - noise.value**2 / study.samples.window
    # of the mismatch: what laws without a name explain, and what nothing does
    beyond = max(quality_after.heldout_rms**2 - noise.value**2, 0.0)
    left_share = min(unnamed + beyond / max(quality_before.heldout_rms**2 - noise.value**2, 1e-300), 1.0)
    silent = withheld(study, fitted.solution, found, mismatch)
    structure = bool(left.any()) or unnamed > UNNAMED_SHARE or bool(shaped) or bool(silent)
    foreign: tuple[str, ...] = ()
    if quality_after.heldout_rms > HOPELESS * float(np.sqrt(np.mean(np.var(bare.y, axis=0)))):
        findings, structure, foreign = (), True, (note("foreign"),)
    verdict = ("partly" if structure else "named") if findings else ("unexplained" if structure else "clean")
    model = SavedModel(
        "motion", robot.name,
        (*effects, *(ModelEffect(f.effect, dict(f.where), {p.name: p.value for p in f.parameters}) for f in late)),
        source=file, taught=taught(fitted, quality_after),
    )  # fmt: skip
    return Diagnosis(
        file=file, kind="motion", robot=robot.name, samples=len(log.t), verdict=verdict, noise=noise,
        before=quality_before, after=quality_after, findings=findings,
        outliers=tuple(int(r) for r in log.dropped), leftover=_leftover(fitted, found, structure, silent, left_share),
        next_poses=poses, seconds=0.0, families=families, model=model.to_dict(),
        notes=(*_notes(fitted), *foreign, *advice),
        evidence=evidence_of(fitted, before, whole, effects),
    )  # fmt: skip


def _changes(fitted: Fitted, member: Member, after: Quality) -> bool:
    """Against a reference: does the held-out error change by more than a hundredth without it?

    That of the whole arm; where nothing is left over on any joint, that of the joint it changes most. What the values
    learnt on the reference must move by to make up for it counts as the error that it would be there.
    """
    study, solution = fitted.study, fitted.solution
    error = float(np.log(_rms_without(fitted, member, moving=True) / after.heldout_rms))
    moved, counts = surprise(study, solution, member.columns)
    stays, _ = surprise(study, solution, np.zeros(0, int))
    if error + (moved - stays) / (counts * study.state.joints) > np.log1p(CHANGE):
        return True
    residual = heldout_without(fitted.study, fitted.solution, member.columns)
    alive = fitted.study.samples.alive
    each = [np.mean(r[:, alive] ** 2, axis=0) for r in (residual, fitted.solution.heldout)]
    return not fitted.left.any() and bool(np.any(each[0] > (1.0 + CHANGE) ** 2 * each[1]))


def _rms_without(fitted: Fitted, member: Member, *, moving: bool = False) -> float:
    """Held-out error [Nm] without a law, the rest refitted.

    Args:
        moving: True where the values learnt on a reference are refitted too, instead of standing as they are.
    """
    samples, columns, held = fitted.study.samples, member.columns, None
    if fitted.prior is not None and not moving:
        (g,) = [k for k in fitted.study.selection if fitted.study.label(k).law is fitted.prior]
        own = fitted.study.group(g).columns
        held = -fitted.study.design.prediction(own, fitted.solution.of(own)[0])
        columns = np.concatenate([columns, own])
    residual = heldout_without(fitted.study, fitted.solution, columns, held)
    left = np.mean(fitted.study.state.hypothesis.recorded(residual)[samples.used] ** 2)
    return float(np.sqrt(left + np.mean(samples.within)))


def _without(
    fitted: Fitted, effects: tuple[ModelEffect, ...], found: list[Member], member: Member, take_as
) -> float:
    """Held-out error [Nm] of the log read without an undone law, the rest refitted."""
    key, where = member.candidate.law.key, member.candidate.place.where
    joint = where.get("joint")
    rest = [
        e for e in effects if e.effect != key or (joint is not None and e.where.get("joint", joint) != joint)
    ]
    samples = take_as(hypothesis_of(rest, fitted.robot.joint_count))
    others = [m for m in found if not m.held]
    learnt = effects[: len(fitted.given)]  # what another log taught stays as it is
    return error_with(samples, others, torque_of(samples, [e for e in rest if e in learnt]))


def _finding(fitted: Fitted, member: Member, after: Quality, undone) -> Finding:
    law, place = member.candidate.law, member.candidate.place
    parameters = law.reported(place, member.values, member.covariance)
    spread = spread_of(fitted.study, fitted.loose, dict(fitted.bends), law, place)
    parameters = tuple(replace(p, std=spread.get(p.name, p.std)) for p in parameters)
    where = {k: (round(v, 4) if isinstance(v, float) else v) for k, v in place.where.items()}
    without = undone(member) if member.held else _rms_without(fitted, member)
    alone = fitted.prior is None
    alike = tuple(
        Alternative(key, w, 0.0) for key, w in law.aliases(place, fitted.robot.joint_count) if alone
    )
    if fitted.log.stiffness is not None and "joint" in place.where:
        joint = {"joint": place.where["joint"]}
        alike += tuple(Alternative(key, joint, 0.0) for key in law.servo_alike)
    others = alike + tuple(
        Alternative(c.law.key, dict(c.place.where), 2.0 * short)
        for c, short in (*member.alike, *rivals(fitted.asked, member))
    )
    return Finding(
        effect=law.key,
        where=where,
        parameters=parameters,
        visible=member.visible,
        p_value=member.p_value,
        heldout_rms_without=without,
        heldout_rms_with=after.heldout_rms,
        alternatives=others,
        sentence=law.sentence(place, parameters),
        equation=law.equation,
        share=member.share,
    )


def _lags(fitted: Fitted, named: list[Member]) -> tuple[Finding, ...]:
    """Joints that answer their commands late; of a servo without torque that is one with a law that is named there."""
    log = fitted.log
    found = lag_findings(log, fitted.study.state.sliding)
    if log.stiffness is None:
        return found
    late = {law.key for law in laws().values() if law.follows_commands}
    one = [law for law in laws().values() if late & set(law.servo_alike)]
    there = {m.candidate.place.where.get("joint") for m in named if m.candidate.law in one}
    alike = lambda f: tuple(Alternative(law.key, {"joint": f.where["joint"]}, 0.0) for law in one)  # noqa: E731
    return tuple(replace(f, alternatives=alike(f)) for f in found if f.where["joint"] not in there)


def _reading_findings(fitted: Fitted, before: Quality, after: Quality) -> tuple[Finding, ...]:
    return tuple(
        Finding(
            effect=law.key, where=dict(place.where),
            parameters=law.reported(place, np.zeros(0), np.zeros((0, 0))), visible=1.0, p_value=CERTAIN,
            heldout_rms_without=before.heldout_rms, heldout_rms_with=after.heldout_rms, alternatives=(),
            sentence=law.sentence(place, ()), equation=law.equation,
        )
        for law, place in ((trial.law, trial.place) for trial in fitted.reading.taken)
        if law.whole_log
    )  # fmt: skip


def _quality(within: np.ndarray, residual: np.ndarray, heldout: np.ndarray, used: np.ndarray) -> Quality:
    """Errors of one sample as it was recorded, not of a window's mean."""
    rest = float(np.mean(within))
    return Quality(
        float(np.sqrt(np.mean(residual[used] ** 2) + rest)),
        float(np.sqrt(np.mean(heldout[used] ** 2) + rest)),
        "Nm",
    )


def _noise(fitted: Fitted) -> Noise:
    study, log = fitted.study, fitted.log
    left = study.design.y - study.design.prediction(fitted.solution.columns, fitted.solution.weights)
    repeated = noise_of_repeats(study.samples, left)
    if repeated is not None:
        value = float(np.sqrt(np.mean(repeated[study.samples.alive] ** 2) * study.samples.window))
        return Noise(value, "Nm", "repeats")
    if log.stated_noise is not None:
        return Noise(float(np.sqrt(np.mean(log.stated_noise**2))), "Nm", "stated")
    spreads = np.array([w.spread for w in study.design.whiteners]) * study.state.hypothesis.factors
    return Noise(float(np.sqrt(np.mean(spreads**2) * study.samples.window)), "Nm", "residual")


def _with_members(
    families: tuple[FamilyShare, ...], findings: tuple[Finding, ...]
) -> tuple[FamilyShare, ...]:
    known = laws()
    return tuple(
        replace(f, members=tuple(i for i, x in enumerate(findings) if known[x.effect].family == f.family))
        for f in families
    )


def _leftover(
    fitted: Fitted, found: list[Member], structure: bool, silent: list[Member], share: float
) -> Leftover:
    study = fitted.study
    j = int(np.argmin(study.leftover_p))
    if not structure:
        return Leftover(float(min(1.0, study.leftover_p[j] * study.design.joints)), {}, share)
    where: dict[str, object] = {"joint": j + 1}
    unnamed = silent or [m for m in found if not m.named and m.asks_for_a_name and m.gain >= NAME]
    if not fitted.left.any() and unnamed:
        where = dict(max(unnamed, key=lambda m: m.share).candidate.place.where)
    return Leftover(float(min(study.leftover_p[j], LEFT_P)), where, share)


def _notes(fitted: Fitted) -> tuple[str, ...]:
    samples, log = fitted.study.samples, fitted.log
    out = [*log.notes, fitted.motion.smoothing.sentence()]
    if samples.window > 1:
        out.append(note("averaged", window=samples.window))
    return tuple(out)
