"""What it all amounts to."""

from __future__ import annotations

import time as clock

import msgspec

from app.diagnosis.result import Diagnosis, Finding, Leftover, Verdict
from app.diagnosis.static.alternatives import overruled
from app.diagnosis.static.as_built import spread_of
from app.diagnosis.static.convention_findings import convention_findings
from app.diagnosis.static.evidence import evidence_of
from app.diagnosis.static.excess import below_noise, beyond_noise
from app.diagnosis.static.findings import findings_of, quality, strong
from app.diagnosis.static.gross import HOPELESS
from app.diagnosis.static.library import GEOMETRY, candidates
from app.diagnosis.static.looking import key_of
from app.diagnosis.static.models import saved_model
from app.diagnosis.static.next_poses import next_poses
from app.diagnosis.static.noise import known_noise, noise_of, position_rms
from app.diagnosis.static.outcome import Outcome
from app.diagnosis.static.plan import Plan
from app.diagnosis.static.remarks import remarks
from app.diagnosis.static.shape import LEVEL as WITHHELD
from app.kinematics import RobotModel

#: Share of a hopeless misfit that findings may leave and still be given.
_LEAVES = 0.01
#: So many laws at once are likelier an approximation of one that has no name here.
CROWD = 5
#: Lengths, twists and zeros together bend to any smooth error of an arm.
CROWD_OF_GEOMETRY = 3
#: m: an arm whose every length is off by this is another arm.
_ANOTHER = 0.02


def conclude(robot: RobotModel, outcome: Outcome, tick, began: float) -> Diagnosis:
    """Words for an outcome."""
    recording, plan = outcome.written.recording, outcome.plan
    found = plan.found.fitted
    tick(0.9, "writing it down")
    wanted = candidates(found.recording.situation)
    hopeless = _hopeless(outcome)
    findings = () if hopeless else findings_of(found, plan.p_values, wanted, plan.shadows)
    if not plan.sound or plan.withheld:
        findings = strong(findings)
    after = quality(found)
    standing = tuple(f for f in findings if not overruled(f.alternatives))
    contested = len(standing) < len(findings)
    findings = (*convention_findings(outcome, after), *standing)
    known = known_noise(recording)
    noise = noise_of(found.recording, known, found)
    excess = beyond_noise(found, known)
    crowd = len(standing) >= CROWD or sum(f.effect in GEOMETRY for f in standing) >= CROWD_OF_GEOMETRY
    left = hopeless or excess or contested or crowd or _structure(plan, findings)
    said = {key_of(f.effect, f.where) for f in findings}
    kept = {id(t) for t in found.terms if (t.tacit and not hopeless) or key_of(t.effect.key, t.where) in said}
    model = saved_model(found, robot.name, recording.file, outcome.written, kept)
    return Diagnosis(
        file=recording.file,
        kind=recording.kind,
        robot=robot.name,
        samples=recording.size,
        verdict=verdict_of(findings, left),
        noise=noise,
        before=quality(outcome.written.before or outcome.before),
        after=after,
        findings=findings,
        outliers=tuple(int(r) for r in recording.rows[outcome.outliers]),
        leftover=leftover_said(plan, hopeless or excess or contested or crowd),
        next_poses=next_poses(robot, found, findings, wanted),
        seconds=clock.perf_counter() - began,
        notes=(*recording.notes, *remarks(outcome, noise, hopeless, excess, len(standing) if crowd else 0)),
        model=msgspec.to_builtins(model),
        evidence=evidence_of(recording, outcome),
    )


def _hopeless(outcome: Outcome) -> bool:
    """True where the measurements and the poses have nothing to do with each other."""
    found = outcome.plan.found.fitted
    before, after = position_rms(outcome.before), position_rms(found)
    collapsed = below_noise(found, known_noise(outcome.written.recording)) or spread_of(found) > _ANOTHER
    return before > HOPELESS and (after > _LEAVES * before or collapsed)


def _structure(plan: Plan, findings: tuple[Finding, ...]) -> bool:
    return bool(plan.withheld) or not plan.sound or (plan.as_built and not findings)


def verdict_of(findings: tuple[Finding, ...], left: bool) -> Verdict:
    """Clean, named, partly or unexplained."""
    if findings:
        return "partly" if left else "named"
    return "unexplained" if left else "clean"


def leftover_said(plan: Plan, beyond: bool) -> Leftover:
    """What is left over; structure that was fitted without a name counts as such."""
    doubt = plan.withheld[0] if plan.withheld else plan.doubt
    if doubt is not None:
        return Leftover(min(plan.leftover.p_value, WITHHELD), dict(doubt.where))
    if beyond:
        return Leftover(min(plan.leftover.p_value, WITHHELD), dict(plan.leftover.where))
    return plan.leftover
