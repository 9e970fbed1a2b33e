"""One arm whose links and joints are none as described, logged twice: what is true and what could be learnt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.linalg import svd

from app.errors import InputError
from app.proof.generator.arm import Arm
from app.proof.generator.effects.term import Request, Term, draw_term, same_place
from app.proof.generator.motion.cell import Motion, drive_torques, effect_on_torques, law_of, scaled_to
from app.proof.generator.motion.columns import Thin, inertial_columns, places, term_columns, thinned
from app.proof.generator.motion.making import RATED, MadeMotion, MotionPlan, draw_motion_cell, record
from app.proof.generator.motion.members import FAMILY_OF, Drives, Member, draw_drive_members
from app.proof.generator.noise import MEMORY
from app.proof.generator.observer import RANK, Linear, Rest, gaps
from app.proof.generator.static.clutter import misweighed
from app.proof.generator.static.visibility import alike

#: Effects that belong to the log they happen in, and those of which nobody can say whether the next one has them.
PASSING = ("contact", "payload_change")
UNSETTLED = ("warmup_friction",)
#: A dominant effect explains this much or more of the description's error.
DOMINANT = 0.4
#: Columns of one link's inertial errors, and the sigma (in units of the column's) of each where masses are off by
#: one per cent of themselves: mass with inertia and the three of the centre; the inertia of its own hardly.
PER_LINK = 10
MOST_MASSES = 0.25
INERTIALS = "inertials"
CENTRE = 1e-3  # m: a load's centre is moved so far to see what that does


@dataclass(frozen=True)
class WholeLog:
    """What is asked for.

    Args:
        plan, second: the two logs.
        drives: how the joints are built.
        masses: share by which masses and centres differ from the description, a link.
        dominant: the one effect that explains most, or None; `share`: how much.
        referenced: the arm is also logged without the dominant effect.
    """

    plan: MotionPlan
    second: MotionPlan
    drives: Drives
    masses: float
    dominant: Request | None = None
    share: float = 0.0
    referenced: bool = False


@dataclass(frozen=True, eq=False)
class WholeLogMade:
    """Two logs of one arm, and the truth; see static/whole.py for the names.

    Args:
        reference: a log of the same arm before the dominant effect came, or None.
        norms: how long each member's effect is over all samples, over the noise.
        oracle: expected rms of ordinary least squares on the second log [Nm].
    """

    first: MadeMotion
    second: MadeMotion
    reference: MadeMotion | None
    members: tuple[Member, ...]
    dominant: bool
    masses: float
    shares: Mapping[str, float]
    norms: tuple[float, ...]
    dominant_share: float
    norm: float
    nearest: float
    lookalikes: tuple[Mapping[str, Any], ...]
    value_sd: float | None
    oracle: float | None
    floor: float


def make_whole_log(
    whole: WholeLog, described: Arm, rng: np.random.Generator, *, outside: frozenset[str], limit: float
) -> WholeLogMade:
    """Both logs and what is true of them.

    Args:
        outside: effects that no library holds.
        limit: difference (length over noise) below which nobody can tell two explanations apart.

    Raises:
        InputError: this arm or log cannot carry the effect, or the effect does not stand out.
    """
    seed, masses = int(rng.integers(2**31)), whole.masses
    arm = misweighed(described, masses, np.random.default_rng(seed))
    cell = draw_motion_cell(whole.plan, arm, described, rng)
    sigma = whole.plan.noise * np.where(arm.effort > 0, arm.effort, RATED)
    members = draw_drive_members(whole.drives, cell, rng)
    if whole.dominant is not None:
        members, factor = _with_dominant(whole, cell, members, sigma, rng)
        masses = min(masses * factor, MOST_MASSES)
        arm = misweighed(described, masses, np.random.default_rng(seed))
        cell = replace(cell, arm=arm)
    terms = [m.term for m in members]
    first = record(whole.plan, cell, terms, (), sigma, rng, raw=False)
    shares, alone = _shares(cell, members, outside)
    dominant = whole.dominant is not None
    if dominant and not whole.referenced and alone < DOMINANT:
        raise InputError("the effect does not stand out", expected="one that does")
    carried = [t for t in terms if not (dominant and t is terms[-1] and t.effect in PASSING)]
    second = _again(whole.second, cell, carried, sigma, rng)
    before = terms[:-1] if dominant else terms
    bare = _again(whole.second, cell, before, sigma, rng) if whole.referenced else None
    known = 0.0 if whole.referenced else masses  # the reference tells the masses
    seen = _seen(first, members, masses, limit, known) if dominant else (0.0, 0.0, (), None)
    settled = not (dominant and terms[-1].effect in UNSETTLED)
    return WholeLogMade(
        first=first,
        second=second,
        reference=bare,
        members=tuple(members),
        dominant=dominant,
        masses=masses,
        shares=shares,
        norms=tuple(
            float(np.linalg.norm(effect_on_torques(cell, terms, t) / sigma)) / np.sqrt(_memory(whole.plan))
            for t in terms
        ),
        dominant_share=alone,
        norm=seen[0],
        nearest=seen[1],
        lookalikes=seen[2],
        value_sd=seen[3],
        oracle=_expected(first, terms, second, carried) if settled else None,
        floor=float(np.sqrt(np.mean(sigma**2))),
    )


def _again(
    plan: MotionPlan, cell: Motion, terms: Sequence[Term], sigma: np.ndarray, rng: np.random.Generator
) -> MadeMotion:
    """Another log of the same arm: another motion, the same joints."""
    there = draw_motion_cell(replace(plan, sharpness=()), cell.arm, cell.described, rng)
    there = replace(there, standstill=cell.standstill, fading=cell.fading)
    return record(plan, there, terms, (), sigma, rng, raw=False)


def _with_dominant(
    whole: WholeLog, cell: Motion, members: list[Member], sigma: np.ndarray, rng: np.random.Generator
) -> tuple[list[Member], float]:
    """The members made so small that the dominant effect explains its share, that effect, and by what factor."""
    assert whole.dominant is not None
    law = law_of(whole.dominant.effect)
    term, open_strength = draw_term(whole.dominant, law, rng, cell)
    if open_strength:
        term = scaled_to(cell, [], term, sigma, whole.plan.strength)
    members = [m for m in members if not same_place(m.term, term)]
    if whole.referenced:
        return [*members, Member(term, None)], 1.0
    alone = effect_on_torques(cell, [term], term)
    rest = drive_torques(cell, [m.term for m in members]) - replace(cell, arm=cell.described).rigid
    ratio = float(np.sum(alone**2) / max(np.sum(rest**2), 1e-300))
    factor = min(float(np.sqrt(ratio * (1.0 - whole.share) / whole.share)), 2.0)
    return [*(m.times(factor) for m in members), Member(term, None)], factor


def _shares(
    cell: Motion, members: Sequence[Member], outside: frozenset[str]
) -> tuple[dict[str, float], float]:
    """Family -> share of the description's error lost without it; and that of the last member alone."""
    described = replace(cell, arm=cell.described)
    true = drive_torques(cell, [m.term for m in members])

    def lost(terms: Sequence[Term], there: Motion = cell) -> float:
        return float(np.mean((true - drive_torques(there, terms)) ** 2))

    whole = lost([], described)
    families: dict[str, list[int]] = {INERTIALS: []}
    for i, member in enumerate(members):
        family = "unnamed" if member.term.effect in outside else FAMILY_OF.get(member.term.effect)
        if family is not None:
            families.setdefault(family, []).append(i)
    shares = {}
    for family, inside in families.items():
        kept = [m.term for i, m in enumerate(members) if i not in inside]
        shares[family] = lost(kept, described if family == INERTIALS else cell) / whole
    return shares, lost([m.term for m in members[:-1]]) / whole


def _seen(first: MadeMotion, members: Sequence[Member], masses: float, limit: float, unsure: float):
    """How the dominant effect stands out: norm, nearest, lookalikes, sigma of its strength.

    Args:
        unsure: share by which masses are not known to an observer of its strength.
    """
    thin = thinned(first)
    weight = thin.weight / np.sqrt(_memory(first.plan))
    others, term = [m.term for m in members[:-1]], members[-1].term
    blocks = [term_columns(thin, [], t) for t in others]
    known = np.hstack([inertial_columns(thin), *blocks]) * weight
    widths = _all_widths(first, masses)
    widths += [m.width or 0.0 for m, b in zip(members[:-1], blocks, strict=True) for _ in range(b.shape[1])]
    effect = thin.effect([*others, term], term) * weight
    linear = Linear(
        np.zeros((effect.size, 0)), np.zeros((effect.size, 0)), effect, np.ones(effect.size, bool)
    )
    rest = Rest(linear, known, np.array(widths))
    candidates = [c for c in places(thin) if not same_place(c, term)]
    length, left = gaps(rest, effect, [term_columns(thin, [], c) * weight for c in candidates])
    told = [
        {"effect": c.effect, "where": dict(c.where), "gap": gap, "free": len(c.parameters)}
        for c, gap in zip(candidates, left, strict=True)
    ]
    alone = length
    if (
        "link" in term.where and term.effect == "payload"
    ):  # where its centre is decides what its mass would be
        rest = Rest(
            linear, known, np.array([*_all_widths(first, unsure), *widths[PER_LINK * first.cell.arm.n :]])
        )
        (alone,) = gaps(rest, effect, [_moved_centre(thin, others, term) * weight])[1]
    sd = 1.0 / alone if alone > 0 else None
    return length, min(left, default=length), alike(told, term, length, limit), sd


def _all_widths(first: MadeMotion, masses: float) -> list[float]:
    return [w for _ in range(first.cell.arm.n) for w in _inertial_widths(masses)]


def _moved_centre(thin: Thin, others: Sequence[Term], term: Term) -> np.ndarray:
    """(m n, 3) what a load's centre does, moved along each axis."""
    base, columns = thin.reading([*others, term]), []
    for axis in "xyz":
        moved = {**term.parameters, f"com_{axis}": term.parameters[f"com_{axis}"] + CENTRE}
        columns.append((thin.reading([*others, replace(term, parameters=moved)]) - base) / CENTRE)
    return np.stack(columns, axis=1)


def _inertial_widths(masses: float) -> list[float]:
    """Sigma of one link's inertial errors in units of the columns': evenly drawn up to the share `masses`."""
    from app.proof.generator.motion.columns import PRIOR

    spread = masses / np.sqrt(3.0)
    return [spread / PRIOR[0]] + 3 * [spread / PRIOR[1]] + 6 * [0.1 * spread / PRIOR[2]]


def _memory(plan: MotionPlan) -> float:
    """By how much noise that remembers makes every mean less certain."""
    return (1.0 + MEMORY) / (1.0 - MEMORY) if plan.noise_kind == "coloured" else 1.0


def _expected(first: MadeMotion, terms: Sequence[Term], second: MadeMotion, carried: Sequence[Term]) -> float:
    """Expected rms on the second log of least squares on every parameter of the true structure [Nm].

    The columns are those of all inertial numbers and of every law that was drawn, at their true shapes; the
    covariance of white noise, widened where the noise remembers.
    """
    here, there = thinned(first), thinned(second)
    count = len(carried)  # what passes stands last
    fitted = np.hstack([inertial_columns(here), *(term_columns(here, [], t) for t in terms)])
    used = np.hstack([inertial_columns(there), *(term_columns(there, [], t) for t in terms[:count])])
    length = np.linalg.norm(fitted, axis=0)
    length[length == 0] = 1.0
    # By the triangular factor: LAPACK's quick method does not converge on some of these tall matrices.
    triangle = np.linalg.qr(fitted / length * here.weight, mode="r")
    _, s, v = svd(triangle, full_matrices=False, lapack_driver="gesvd")
    v = v[s > RANK * s[0]] / s[s > RANK * s[0], None]
    moved = (used / length[: used.shape[1]]) @ v[:, : used.shape[1]].T
    added = _memory(first.plan) * np.sum(moved**2, axis=1).reshape(-1, first.cell.arm.n)
    return float(np.sqrt(np.mean(there.sigma**2 * (1.0 + added.mean(axis=0)))))
