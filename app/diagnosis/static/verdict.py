"""What it all amounts to."""

from __future__ import annotations

import msgspec

from app.diagnosis.result import Diagnosis, Leftover, Verdict
from app.diagnosis.static.evidence import evidence_of
from app.diagnosis.static.findings import findings_of, quality
from app.diagnosis.static.library import candidates
from app.diagnosis.static.models import saved_model
from app.diagnosis.static.noise import known_noise, noise_of
from app.diagnosis.static.plan import Plan
from app.diagnosis.static.shape import LEVEL as WITHHELD


def conclude(recording, robot, outcome, held, seed, tick, seconds) -> Diagnosis:
    found = outcome.found.fitted
    tick(0.9, "writing it down")
    named = [t for t in found.terms if not t.tacit]
    p_values = {t.label: p for t, p in zip(named, outcome.found.p_values, strict=False)}
    findings = findings_of(found, p_values, candidates(found.recording.situation))
    noise = noise_of(found.recording, known_noise(recording), found)
    return Diagnosis(
        file=recording.file,
        kind=recording.kind,
        robot=robot.name,
        samples=recording.size,
        verdict=verdict_of(findings, outcome.plan),
        noise=noise,
        before=quality(outcome.before),
        after=quality(found),
        findings=findings,
        outliers=tuple(int(r) for r in recording.rows[outcome.outliers]),
        leftover=leftover_said(outcome.plan),
        next_poses=(),
        seconds=seconds,
        notes=recording.notes,
        model=msgspec.to_builtins(saved_model(found, robot.name, recording.file)),
        evidence=evidence_of(recording, outcome),
    )


def verdict_of(findings, plan: Plan) -> Verdict:
    """Clean, named, partly or unexplained."""
    left = bool(plan.withheld) or not plan.sound or (plan.as_built and not findings)
    if findings:
        return "partly" if left else "named"
    return "unexplained" if left else "clean"


def leftover_said(plan: Plan) -> Leftover:
    """What is left over; structure that was fitted without a name counts as such."""
    doubt = plan.withheld[0] if plan.withheld else plan.doubt
    if doubt is not None:
        return Leftover(min(plan.leftover.p_value, WITHHELD), dict(doubt.where))
    return plan.leftover
