"""One arm that is off everywhere, recorded twice: what is true of it and what could be learnt of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.errors import InputError
from app.proof.generator.arm import Arm
from app.proof.generator.effects.term import Request, Term, draw_term, same_place
from app.proof.generator.observer import (
    Linear,
    Rest,
    carried_rms,
    gaps,
    informed_error,
    oracle_error,
    share_uncertainty,
)
from app.proof.generator.static.cell import Cell, law_of, scaled_to, seen, turned, world_with
from app.proof.generator.static.clutter import misweighed
from app.proof.generator.static.linear import Levers, free_names
from app.proof.generator.static.making import Made, measure
from app.proof.generator.static.members import FAMILY_OF, Build, Member, draw_members
from app.proof.generator.static.plan import Plan
from app.proof.generator.static.rivals import rivals
from app.proof.generator.static.setting import draw_cell
from app.proof.generator.static.visibility import alike

#: Effects that belong to the run they happen in: the arm of the next run does not have them any more, …
PASSING = ("base_shift", "tool_slip")
#: … and those of which nobody can say whether it has: the model carried over is not judged.
UNSETTLED = (
    "joint_slip", "joint_drift", "base_drift", "thermal_growth", "instrument_zero_shift", "daily_wave"
)  # fmt: skip
UNNAMED = "unnamed"
#: Of these only a part is independent, see members.py.
REDUNDANT = ("joint_zero", "link_length", "link_twist")
#: A dominant effect explains this much or more of what base and tool leave.
DOMINANT = 0.4


@dataclass(frozen=True)
class Whole:
    """What is asked for.

    Args:
        plan, second: the two recordings.
        build: how the arm was built.
        dominant: the one effect that explains most, or None; `share`: how much.
        masses: share by which masses and centres differ from the description.
    """

    plan: Plan
    second: Plan
    build: Build
    dominant: Request | None = None
    share: float = 0.0
    masses: float = 0.0


@dataclass(frozen=True, eq=False)
class WholeMade:
    """Two recordings of one arm, and the truth.

    Args:
        first, second: the recordings.
        members: its deviations, the dominant one last where there is one.
        dominant: is there one.
        shares: family -> (share of the budget, one sigma of it as the informed observer knows it).
        norms: how long each member's effect is over all readings, over the noise, once base and tool are fitted.
        dominant_share: of the dominant effect alone.
        norm: its length over all readings, over the noise, once everything else took what it can.
        nearest, lookalikes: how much of it the most similar other law leaves, and the laws nobody can tell from it.
        value_sd: one sigma of its strength as the informed observer knows it, as a share of it.
        oracle, informed: rms on the second recording of the two observers' models [m]; None where nothing can be
            said of it.
    """

    first: Made
    second: Made
    members: tuple[Member, ...]
    dominant: bool
    shares: Mapping[str, tuple[float, float]]
    norms: tuple[float, ...]
    dominant_share: float
    norm: float
    nearest: float
    lookalikes: tuple[Mapping[str, Any], ...]
    value_sd: float | None
    oracle: float | None
    informed: float | None


def make_whole(
    whole: Whole, described: Arm, rng: np.random.Generator, *, outside: frozenset[str], limit: float
) -> WholeMade:
    """Both recordings and what is true of them.

    Args:
        outside: effects that no library holds.
        limit: difference (length over noise) below which nobody can tell two explanations apart.

    Raises:
        InputError: this arm cannot carry the effect, cannot touch so often, or the effect does not stand out.
    """
    arm = misweighed(described, whole.masses, rng) if whole.masses else described
    cell, pose = draw_cell(whole.plan, arm, described, rng)
    members = draw_members(whole.build, described, np.sqrt(np.mean(cell.holding**2, axis=0)), rng)
    if whole.dominant is not None:
        members = _with_dominant(whole, cell, members, rng)
    terms = [m.term for m in members]
    first = measure(whole.plan, cell, pose, terms, rng, raw=False)
    levers = Levers(first)
    linear = linear_of(levers, terms)
    dominant = whole.dominant is not None
    shares, alone = _shares(levers, linear, members, outside)
    if dominant and alone < DOMINANT:
        raise InputError("the effect hides in base and tool", expected="one that stands out")
    seen = _seen(levers, linear, members, limit) if dominant else (0.0, 0.0, (), None)
    carried = [m for m in members if not (dominant and m is members[-1] and m.term.effect in PASSING)]
    there, again = draw_cell(whole.second, arm, described, rng)
    there = replace(there, gravity=cell.gravity)
    second = measure(whole.second, there, again, [m.term for m in carried], rng, raw=False)
    unsettled = dominant and terms[-1].effect in UNSETTLED
    errors = (None, None) if unsettled else _carried(linear, members, second, carried)
    norms = _norms(linear, members)
    return WholeMade(first, second, tuple(members), dominant, shares, norms, alone, *seen, *errors)


def linear_of(levers: Levers, terms: Sequence[Term]) -> Linear:
    """A recording about its truth, as an observer reckons it who has the file and the description.

    What these do not tell (masses, a lean, where a row was come from) is error to him. Rows that went wrong
    are left out.
    """
    kept, error = levers.kept(), levers.error.ravel()
    columns = levers.columns(terms)
    if levers.misled:
        true, columns = columns, levers.columns(terms, told=True)
        error = error + (true - columns) @ np.array([v for t in terms for v in _strengths(t)])
    return Linear(columns[kept], levers.opened()[kept], error[kept], levers.of_points()[kept])


def _strengths(term: Term) -> list[float]:
    return [term.parameters[name] for name in free_names(term)]


def _with_dominant(whole: Whole, cell: Cell, members: list[Member], rng: np.random.Generator) -> list[Member]:
    """The members made so small that the dominant effect explains its share, and that effect."""
    assert whole.dominant is not None
    term, open_strength = draw_term(whole.dominant, law_of(whole.dominant.effect), rng, cell)
    if open_strength:
        term = scaled_to(cell, [], term, whole.plan.effect_rms)
        if term.effect == "backlash" and rng.random() < whole.build.over:
            term = term.times(-1.0)
    others = [m for m in members if not same_place(m.term, term)]
    if term.effect in REDUNDANT and len(others) == len(members):
        raise InputError(
            "this is another's doing", expected="geometry that no other part of the arm can imitate"
        )
    members = others
    # a first look at the recording without noise, to see how large either is once base and tool are fitted
    bare = _still(whole.plan, cell)
    levers = Levers(bare)
    opened = Linear(
        np.zeros((levers.error.size, 0)), levers.opened(), levers.error.ravel(), levers.of_points()
    )
    rest = sum((levers.columns([m.term]) @ _values([m]) for m in members), np.zeros(levers.error.size))
    moved = Levers(replace(bare, terms=(term,))).missing([]).ravel()
    sizes = [float(np.sum(opened.freed(v)[opened.counted] ** 2)) for v in (moved, rest)]
    factor = np.sqrt(sizes[0] / max(sizes[1], 1e-300) * (1.0 - whole.share) / whole.share)
    return [*(m.times(float(factor)) for m in members), Member(term, None)]


def _still(plan: Plan, cell: Cell) -> Made:
    """A recording of the bare arm without noise: only its columns are of interest."""
    world = world_with(cell, ())
    points = seen(cell, world) if cell.kind == "tracker" else cell.targets[cell.target][:, None]
    lengths = np.linalg.norm(points[:, 0], axis=1) if plan.wire else None
    orientations = turned(cell, world) if plan.orientation else None
    return Made(
        plan, cell, (), (), points, lengths, orientations, None, np.zeros(0, int), np.zeros(cell.m, int)
    )


def _values(members: Sequence[Member]) -> np.ndarray:
    return np.array([v for m in members for v in m.term.parameters.values()])


def _widths(members: Sequence[Member]) -> np.ndarray:
    """(p,) one sigma of each parameter; infinite for the dominant effect."""
    return np.array([np.inf if m.width is None else m.width for m in members for _ in m.term.parameters])


def _places(members: Sequence[Member]) -> list[list[int]]:
    """Columns of each member."""
    ends = np.cumsum([len(m.term.parameters) for m in members])
    return [list(range(end - len(m.term.parameters), end)) for m, end in zip(members, ends, strict=True)]


def _shares(
    levers: Levers, linear: Linear, members: Sequence[Member], outside: frozenset[str]
) -> tuple[dict[str, tuple[float, float]], float]:
    """Family -> share lost without it and its sigma; and the share of the last member alone."""
    kept = levers.kept()

    def lost(terms: Sequence[Term]) -> float:
        left = linear.freed(levers.missing(terms).ravel()[kept])
        return float(np.mean(left[linear.counted] ** 2))

    whole = lost([])
    families: dict[str, list[int]] = {}
    for i, member in enumerate(members):
        effect = member.term.effect
        family = UNNAMED if effect in outside else FAMILY_OF.get(effect)
        if family is not None:
            families.setdefault(family, []).append(i)
    columns = _places(members)
    sigma = share_uncertainty(
        linear,
        _values(members),
        _widths(members),
        {family: [c for i in inside for c in columns[i]] for family, inside in families.items()},
    )
    shares = {
        family: (lost([m.term for i, m in enumerate(members) if i not in inside]) / whole, sigma[family])
        for family, inside in families.items()
    }
    alone = lost([m.term for m in members[:-1]]) / whole if members else 0.0
    return shares, alone


def _norms(linear: Linear, members: Sequence[Member]) -> tuple[float, ...]:
    columns = linear.freed(linear.columns)
    each = zip(members, _places(members), strict=True)
    return tuple(float(np.linalg.norm(columns[:, at] @ _values([m]))) for m, at in each)


def _seen(levers: Levers, linear: Linear, members: Sequence[Member], limit: float):
    """How the dominant effect stands out: norm, nearest, lookalikes, sigma of its strength."""
    others, (member,) = members[:-1], members[-1:]
    count = sum(len(m.term.parameters) for m in others)
    rest = Rest(linear, linear.columns[:, :count], _widths(others))
    own = linear.columns[:, count:]
    effect = own @ _values([member])
    kept = levers.kept()
    candidates = list(rivals(levers, member.term))
    length, left = gaps(rest, effect, [block[kept] for _, block in candidates])
    told = [
        {"effect": term.effect, "where": dict(term.where), "gap": gap, "free": block.shape[1]}
        for (term, block), gap in zip(candidates, left, strict=True)
    ]
    freed = linear.freed(own)
    spread = np.linalg.pinv(rest.products(freed, freed))
    values = _values([member])
    relative = float(np.sqrt(np.trace(spread)) / max(np.linalg.norm(values), 1e-300))
    return length, min(left, default=length), alike(told, member.term, length, limit), relative


def _carried(
    linear: Linear, members: Sequence[Member], second: Made, carried: Sequence[Member]
) -> tuple[float, float]:
    """Rms on the second recording of the oracle's and of the informed observer's model [m]."""
    other = linear_of(Levers(second), [m.term for m in carried])
    count = other.columns.shape[1]  # what passes stands last
    oracle = oracle_error(linear)[:count]
    informed = informed_error(linear, _values(members), _widths(members))[:count]
    sigma = second.plan.noise
    return sigma * carried_rms(other, oracle), sigma * carried_rms(other, informed)
