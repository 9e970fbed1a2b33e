"""One log through the search: samples, library, selection, exact refit, judgement, in rounds until it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.model import ModelEffect
from app.diagnosis.motion.baseline import Baseline, known_terms, without_baseline
from app.diagnosis.motion.corrections import Corrections, corrected_by, further
from app.diagnosis.motion.errors import ErrorTable
from app.diagnosis.motion.exact import ExactFit, exact_fit
from app.diagnosis.motion.library import curve_groups, law_groups, laws
from app.diagnosis.motion.log import Log
from app.diagnosis.motion.names import Judgement, judge
from app.diagnosis.motion.noise import noise_of_motion, whiteners_of
from app.diagnosis.motion.prior import choose_scale, prior_factor
from app.diagnosis.motion.refining import refine
from app.diagnosis.motion.sampling import Motion, Samples, take_samples
from app.diagnosis.motion.search import Search, Term
from app.diagnosis.motion.system import Group, System
from app.diagnosis.result import Progress
from app.diagnosis.wording import note
from app.kinematics import RobotModel
from app.kinematics.robot import GRAVITY

MOST_ROUNDS = 3
LEAST_BEFORE = 0.06  # share of the log's usable rows on either side of a change


@dataclass(frozen=True, eq=False)
class Study:
    """One log through the search."""

    log: Log
    samples: Samples
    system: System
    prior: np.ndarray
    prior_scale: float
    corrections: Corrections
    fit: ExactFit
    judgement: Judgement
    search: Search
    done: dict[int, np.ndarray]
    before_residual: np.ndarray
    before_heldout: float
    known: int
    notes: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Given:
    """What is known before the search.

    Args:
        base: what a reference run showed.
        effects: of a saved model, taken as part of the robot.
        without: keys of effects that cannot be told in this log.
        mass_prior: relative one-sigma of the links' masses.
    """

    base: Baseline | None = None
    effects: Sequence[ModelEffect] = ()
    without: frozenset[str] = frozenset()
    mass_prior: float = 0.03


def examine(
    log: Log,
    robot: RobotModel,
    motion: Motion,
    tell: Progress,
    seed: int,
    given: Given = Given(),
) -> Study:
    """Search, exact refit and judgement of one log."""
    base = given.base
    # What the reference's laws add belongs to its own samples.
    first = (
        replace(base.corrections, beyond=None)
        if base
        else Corrections(0.0, np.zeros(robot.joint_count), GRAVITY.copy())
    )
    corrections, factor = first, prior_factor(robot, given.mass_prior)
    terms: list[Term] = []
    before: tuple[np.ndarray, float] | None = None
    rounds = 0
    while True:
        rounds += 1
        samples, referred = _samples(log, robot, motion, tell, corrections, given)
        system, groups, prior, scale, windows = prepare(samples, factor, terms, given.without)
        known = known_terms(system, base) if base else []
        if base:
            prior, scale = base.information, 1.0
        search = Search(system, prior, groups, windows, seed, change=base is not None, known=len(known))
        if before is None:
            bare = ErrorTable(system, prior, [t.group for t in known], samples.y)
            everything = list(range(len(known)))
            before = (bare.residual(everything), bare.heldout(everything))
        start, stay = carried(system, groups, terms)
        events = {_event(t) for t in start}
        stay += len(known)
        terms = [*known, *start] if log.foreign else _selected(search, tell, [*known, *start], stay)
        fit = exact_fit(system, prior, terms)
        kept = search.backward(fit.terms, stay)
        if len(kept) < len(fit.terms):
            fit = exact_fit(system, prior, kept)
        terms = fit.terms[len(known) :]
        new = further(corrections, system, fit)
        if rounds == MOST_ROUNDS or (
            new is None and {_event(t) for t in terms if _law(t).windowed} <= events
        ):
            break
        corrections = new or corrections
    tell(0.85, "names")
    stated, moved = None, noise_of_motion(robot, samples)
    if log.stated_noise is not None:
        recorded = log.stated_noise / np.abs(1.0 + corrections.scale)  # in the torque that was meant
        stated = np.sqrt(recorded**2 / samples.window + moved**2)
    if base and stated is not None:
        stated = None if referred.startswith("the reference follows the same") else stated
    done = corrected_by(corrections, first, fit)
    judgement = judge(search, fit, stated, moved, done)
    if log.foreign:
        judgement = replace(
            judgement, named=[False] * len(fit.terms), reasons=(note("foreign"),), leftover_p=1 / 200
        )
    notes = (referred,) if referred else ()
    return Study(
        log,
        samples,
        system,
        prior,
        scale,
        corrections,
        fit,
        judgement,
        search,
        done,
        *before,
        len(known),
        notes,
    )


def _selected(search: Search, tell: Progress, start: list[Term], stay: int) -> list[Term]:
    """Forward, then refined, until the refined terms leave nothing more to take."""
    terms = search.forward(tell, start, stay)
    for _ in range(MOST_ROUNDS):
        refined = search.backward(refine(search, terms, stay), stay)
        if [t.group for t in refined] == [t.group for t in terms]:
            return terms
        terms = search.forward(tell, refined, stay)
    return refine(search, terms, stay)


def _law(term: Term):
    assert term.group.law is not None
    return term.group.law


def _samples(
    log: Log, robot: RobotModel, motion: Motion, tell: Progress, corrections: Corrections, given: Given
) -> tuple[Samples, str]:
    """The log's samples, corrected, without what is known already; and a note on a reference."""
    samples = take_samples(
        log,
        robot,
        motion,
        log.y / (1.0 + corrections.scale),
        tell,
        shift=corrections.delay,
        gravity=corrections.gravity,
    )
    if corrections.beyond is not None:
        samples = samples.with_torque(corrections.beyond)
    y = samples.y.copy()
    for effect in given.effects:
        law = laws().get(effect.effect)
        if law is None:
            continue
        added = samples.pool(law.apply(samples.state, effect.where, effect.parameters))
        if added.ndim == 1:
            y[:, int(effect.where["joint"]) - 1] -= added
        else:
            y -= added
    samples = replace(samples, y=y)
    return without_baseline(samples, given.base) if given.base else (samples, "")


def carried(system: System, groups: list[Group], terms: list[Term]) -> tuple[list[Term], int]:
    """Terms of the last round for this one, and how many of them stay whatever comes.

    Those that the samples were corrected for stand first and stay: what remains of them is nothing now.
    """
    stay, rest = [], []
    for term in terms:
        law = term.group.law
        assert law is not None
        if law.corrected:
            same = [g for g in groups if g.law is law and dict(g.where) == dict(term.group.where)]
            stay += [replace(term, group=g) for g in same]
            continue
        columns = system.samples.pool(law.columns(system.samples.state, term.group.where, term.group.shape))
        group = replace(term.group, size=columns.shape[-1], bent=False)
        rest.append(replace(term, group=system.append(group, columns)))
    return stay + rest, len(stay)


def _event(term: Term) -> tuple:
    """A term's key, its times rounded: the same event found again."""
    where = term.group.where
    return (term.group.label, *(round(float(where[k]), 1) for k in ("from_s", "to_s") if k in where))


def prepare(
    samples: Samples, factor: np.ndarray, found: list[Term], without: frozenset[str] = frozenset()
) -> tuple[System, list[Group], np.ndarray, float, dict[Group, np.ndarray]]:
    """Library, noise, Gram matrices and the prior for these samples."""
    shared, local = law_groups(samples, without)
    curves = curve_groups(samples)
    both = [a + b for a, b in zip(local, curves, strict=True)]
    extra = [
        (t.group, samples.pool(t.group.law.columns(samples.state, t.group.where, t.group.shape)))
        for t in found
        if t.group.law is not None and t.group.law.windowed
    ]
    whiteners = whiteners_of(samples, shared, both, extra)
    system = System(samples, whiteners, shared, both)
    for group, columns in extra:
        system.append(group, columns)
    scale = _prior_scale(system, factor)
    prior = np.linalg.inv(factor @ factor.T) / scale**2
    groups = [g for g, _ in shared] + [g for part in local for g, _ in part]
    windows = {g: _windows(g, samples) for g in groups if g.base}
    return system, groups, prior, scale, windows


def _windows(group: Group, samples: Samples) -> np.ndarray:
    """(w, 2) block edges an event may have; a change leaves enough of the log before and after it."""
    assert group.law is not None
    blocks = samples.block_count
    if group.law.key == "payload_change":
        rows = np.bincount(samples.blocks, samples.usable.sum(axis=1), blocks)
        before = np.concatenate([[0.0], np.cumsum(rows)]) / max(rows.sum(), 1.0)
        inside = (before > LEAST_BEFORE) & (before < 1 - LEAST_BEFORE)
        return np.array([(a, blocks) for a in np.flatnonzero(inside[:-1])]).reshape(-1, 2)
    longest = blocks // 3
    return np.array([(a, b) for a in range(blocks) for b in range(a + 1, min(a + longest, blocks) + 1)])


def _prior_scale(system: System, factor: np.ndarray) -> float:
    """What the log says of the description's masses once every law and curve has had its share."""
    size = system.inertial_size
    gram, rhs = np.zeros((size, size)), np.zeros(size)
    for j, part in enumerate(system.parts):
        inertial = np.arange(1, 1 + size - 10 * j)
        others = np.arange(1 + len(inertial), part.columns.shape[1])
        G = part.total
        scale = np.sqrt(np.maximum(np.diag(G)[others], 1e-300))
        own = G[np.ix_(others, others)] / scale / scale[:, None]
        own[np.diag_indices_from(own)] += 1e-8
        cross = G[np.ix_(inertial, others)] / scale
        weight = np.linalg.solve(own, np.column_stack([cross.T, G[others, 0] / scale]))
        at = np.arange(10 * j, size)
        gram[np.ix_(at, at)] += G[np.ix_(inertial, inertial)] - cross @ weight[:, :-1]
        rhs[at] += G[inertial, 0] - cross @ weight[:, -1]
    return choose_scale(0.5 * (gram + gram.T), rhs, factor)
