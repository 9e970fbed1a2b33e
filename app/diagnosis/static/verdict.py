"""What it all amounts to."""

from __future__ import annotations

import msgspec

from app.diagnosis.result import Diagnosis, Verdict
from app.diagnosis.static.evidence import evidence_of
from app.diagnosis.static.findings import findings_of, quality
from app.diagnosis.static.leftover import LEVEL
from app.diagnosis.static.library import candidates
from app.diagnosis.static.models import saved_model
from app.diagnosis.static.noise import known_noise, noise_of


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
        leftover=outcome.plan.leftover,
        next_poses=(),
        seconds=seconds,
        notes=recording.notes,
        model=msgspec.to_builtins(saved_model(found, robot.name, recording.file)),
        evidence=evidence_of(recording, outcome),
    )


def verdict_of(findings, plan) -> Verdict:
    """Clean, named, partly or unexplained."""
    left = plan.leftover.p_value <= LEVEL
    if findings:
        return "partly" if left else "named"
    return "unexplained" if left else "clean"
