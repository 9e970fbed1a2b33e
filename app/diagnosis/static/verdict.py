"""What it all amounts to."""

from __future__ import annotations

import msgspec

from app.diagnosis.result import Diagnosis, Leftover
from app.diagnosis.static.evidence import evidence_of
from app.diagnosis.static.findings import findings_of, quality
from app.diagnosis.static.library import candidates
from app.diagnosis.static.models import saved_model
from app.diagnosis.static.noise import known_noise, noise_of


def conclude(recording, robot, outcome, held, seed, tick, seconds) -> Diagnosis:
    found = outcome.found.fitted
    tick(0.9, "writing it down")
    p_values = {
        t.label: p
        for t, p in zip([t for t in found.terms if not t.tacit], outcome.found.p_values, strict=False)
    }
    findings = findings_of(found, p_values, candidates(found.recording.situation))
    noise = noise_of(found.recording, known_noise(recording), found)
    return Diagnosis(
        file=recording.file,
        kind=recording.kind,
        robot=robot.name,
        samples=recording.size,
        verdict="named" if findings else "clean",
        noise=noise,
        before=quality(outcome.before),
        after=quality(found),
        findings=findings,
        outliers=tuple(int(r) for r in recording.rows[outcome.outliers]),
        leftover=Leftover(1.0, {}),
        next_poses=(),
        seconds=seconds,
        notes=recording.notes,
        model=msgspec.to_builtins(saved_model(found, robot.name, recording.file)),
        evidence=evidence_of(recording, outcome),
    )
