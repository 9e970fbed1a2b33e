"""The whole for touches and tracker points: a table in, a diagnosis out."""

from __future__ import annotations

import time as clock
from dataclasses import replace

import msgspec
import numpy as np

from app.diagnosis.kinematic import budget
from app.diagnosis.kinematic.conventions_found import convention_findings
from app.diagnosis.kinematic.describe import describe
from app.diagnosis.kinematic.description import Description
from app.diagnosis.kinematic.findings import Named, findings, named
from app.diagnosis.kinematic.hypotheses import Written, rewritten
from app.diagnosis.kinematic.judging import Judgement, judged, quality_of
from app.diagnosis.kinematic.left import Left, left_over
from app.diagnosis.kinematic.next_poses import next_poses
from app.diagnosis.kinematic.orientation import with_worth
from app.diagnosis.kinematic.pictures import evidence_of
from app.diagnosis.kinematic.regions import local
from app.diagnosis.kinematic.remarks import remarks
from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.models.kinematic.saved import (
    convention_effects,
    fingerprint,
    held_terms,
    model_effects,
    setup_numbers,
    taught_by,
    undone,
)
from app.diagnosis.models.kinematic.terms import Term
from app.diagnosis.observations.noise import known_noise, noise_of
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.observations.pose_reading import read_static
from app.diagnosis.result import UNNAMED, Diagnosis, FamilyShare, Leftover, Progress, Verdict
from app.diagnosis.thresholds.rows import OUTLIER_WEIGHT
from app.kinematics import RobotModel
from app.recordings import Table


def diagnose(
    table: Table,
    robot: RobotModel,
    *,
    progress: Progress | None = None,
    seed: int = 0,
    model: SavedModel | None = None,
) -> Diagnosis:
    """Where a touch or tracker recording differs from the robot's description, and what it is.

    Args:
        progress: called with the share done; may raise Cancelled.
        seed: of the sign flips.
        model: effects known already; they are applied first.

    Raises:
        InputError, DegenerateGeometryError: the recording cannot be used.
    """
    began = clock.perf_counter()
    tick = progress or (lambda share, what: None)
    tick(0.0, "reading")
    recording = read_static(table, robot)
    told, held = recording, ()
    if model is not None:
        told = undone(model, recording, robot)
        held = held_terms(model, told.situation, fingerprint(recording))
    tick(0.05, "fitting base and tool")
    written = rewritten(told, robot)
    found = describe(with_worth(written.recording, held), held, tick)
    tick(0.85, "writing it down")
    diagnosis = _concluded(recording, robot, written, found, model, seed)
    tick(1.0, "done")
    return replace(diagnosis, seconds=clock.perf_counter() - began)


def _concluded(
    recording: StaticRecording,
    robot: RobotModel,
    written: Written,
    found: Description,
    given: SavedModel | None,
    seed: int,
) -> Diagnosis:
    """Names, budget, the saved model, and the errors that it gives."""
    names, whole = named(found), found.calibrated or found
    spoken = frozenset(found.library.fixed[n.number].label for n in names)
    kept = found.rows > OUTLIER_WEIGHT
    parts = budget.shared_terms(whole, spoken, local(whole, kept))
    saved = _model(recording, robot, written, whole, given, spoken, parts)
    judgement = judged(recording, robot, saved, given)
    after = budget.heldout_after(whole, judgement.kept)  # of the very rows that "before" and "after" count
    heldout = list(after.values())[-1] if after else quality_of(whole.state, judgement.kept).heldout_rms
    if heldout > 0:
        taught = msgspec.structs.replace(saved.taught, heldout_rms=heldout)
        saved = msgspec.structs.replace(saved, taught=taught)
        judgement = replace(judgement, after_quality=replace(judgement.after_quality, heldout_rms=heldout))
    freedom = _freedom(whole)
    known_before = known_noise(written.recording)
    noise = noise_of(written.recording, known_before, judgement.after, judgement.kept, freedom)
    left = left_over(found, judgement, noise, known_before.dof, freedom)
    names = [] if left.hopeless else names
    said = (
        *convention_findings(written, judgement, surely=left.hopeless),
        *findings(found, names, judgement.after_quality.heldout_rms, seed),
    )
    shares = _families(whole, written, parts, said, names, judgement, left, after)
    return Diagnosis(
        file=recording.file,
        kind=recording.kind,
        robot=robot.name,
        samples=recording.size,
        verdict=_verdict(said, left, found),
        noise=noise,
        before=judgement.before_quality,
        after=judgement.after_quality,
        findings=said,
        outliers=tuple(int(r) for r in recording.rows[~judgement.kept]),
        leftover=Leftover(left.p_value, left.where, left.share),
        next_poses=next_poses(robot, found, names, said),
        seconds=0.0,
        families=shares,
        notes=(*recording.notes, *remarks(found, judgement, noise, left, robot.name)),
        model=msgspec.to_builtins(saved),
        evidence=evidence_of(recording, judgement),
    )


def _verdict(said: tuple, left: Left, found: Description) -> Verdict:
    """Clean is only said of a description that stands as it was given: nothing had to be moved."""
    if said:
        return "partly" if left.structure else "named"
    return "unexplained" if left.structure or found.selection or found.calibrated else "clean"


def _freedom(found: Description) -> float:
    """Part of the measured values that the fit has not used up."""
    size = float(np.count_nonzero(found.state.weights, axis=0) @ found.state.recording.worth)
    trace = _effective(found) + found.linear.design.free_count
    return max(1.0 - trace / max(size, 1), 0.05)


def _effective(found: Description) -> float:
    """Effective number of weights: each counts by how far the data, and not the prior, settle it."""
    if not found.selection:
        return 0.0
    factor = found.evidence.factor(found.selection)
    gamma = np.concatenate(
        [np.full(len(found.linear.groups[g].columns), v) for g, v in found.selection.items()]
    )
    half = np.linalg.solve(factor.lower, np.eye(len(gamma)))
    return float(len(gamma) - np.sum(half**2 / gamma))


def _model(
    recording: StaticRecording,
    robot: RobotModel,
    written: Written,
    found: Description,
    given: SavedModel | None,
    spoken: frozenset[tuple],
    parts: list[tuple[str, Term]],
) -> SavedModel:
    """The whole fit: conventions, what was known, findings, members of families and unnamed parts."""
    terms, claimed = [], set()
    for _, term in parts:
        mine = term.label in spoken and term.label not in claimed
        claimed |= {term.label} if mine else set()
        terms.append(replace(term, named=mine))
    known: tuple[ModelEffect, ...] = () if given is None else given.effects
    return SavedModel(
        "static",
        robot.name,
        (
            *known,
            *convention_effects(c for c, _ in written.found),
            *model_effects(written.recording.situation, terms),
        ),
        setup_numbers(found.state.setup),
        recording.file,
        taught_by(recording),
    )


def _families(
    found: Description,
    written: Written,
    parts: list[tuple[str, Term]],
    said: tuple,
    names: list[Named],
    judgement: Judgement,
    left: Left,
    after: dict[str, float],
) -> tuple[FamilyShare, ...]:
    undone_share = 0.0
    plain = quality_of(found.plain, judgement.kept)
    if written.found:
        ratio = plain.fit_rms / max(judgement.before_quality.fit_rms, 1e-12)
        undone_share = float(np.clip(1.0 - ratio**2, 0.0, 1.0))
    conventions = len(said) - len(names)
    family_of = ["conventions"] * conventions + [found.library.fixed[n.number].effect.family for n in names]
    out = list(
        budget.families(found, parts, family_of, after, undone_share, plain.heldout_rms, left.noise_ratio)
    )
    unnamed = [f for f in out if f.family == UNNAMED]
    if left.structure and not unnamed and left.share > 0:
        out.append(FamilyShare(UNNAMED, left.share, judgement.after_quality.heldout_rms))
    return tuple(out)
