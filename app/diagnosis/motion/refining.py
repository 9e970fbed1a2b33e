"""What was taken one by one, looked at again together: a better law in a place, an event at a better time."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.motion.bending import bent
from app.diagnosis.motion.friction import BETTER, RARE, choose_friction
from app.diagnosis.motion.locate import located
from app.diagnosis.motion.scoring import Candidate, score_all, solve
from app.diagnosis.motion.search import LEVEL, Term, is_common, key_of
from app.diagnosis.motion.system import Group, System

if TYPE_CHECKING:
    from app.diagnosis.motion.search import Search

PASSES = 3
TRIED = 4  # laws bent in one place
NEAR = 0.8  # of what is there must a law explain before its shape is bent: shapes lie close on the grid
SHADOW = 0.05  # of what a law adds to a simpler one within it, beyond which a free curve shows it is another
SHAPELY = 0.03  # share of its gain by which a law with a shape must beat one without
OVERLAP = 0.7  # of both windows together, beyond which two events are one
SAME_TIME = 0.5  # s between two changes that are one


def refine(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Exchanges laws and moves events until nothing changes; the first `stay` terms stay as they are."""
    terms = merge(terms, stay)
    for _ in range(PASSES):
        before = [t.group for t in terms]
        terms = exchange(search, reshape(search, relocate(search, terms, stay), stay), stay)
        terms = simplify(search, choose_friction(search, terms, stay), stay)
        if [t.group for t in terms] == before:
            break
    return terms


def exchange(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Puts a commoner or better law of the same joint in the place of one that was taken."""
    system, penalty = search.system, np.log(max(search.system.rows, 3))
    for i in range(stay, len(terms)):
        term = terms[i]
        if term.group.joint is None:
            continue
        others = [t.group for k, t in enumerate(terms) if k != i]
        gain = search.losses_without([t.group for t in terms])[i]
        own = gain - penalty * _freedom(term.group)
        taken = {key_of(g) for g in others[search.known :]}
        here = [g for g in search.groups if g.joint == term.group.joint and not g.base and g.key not in taken]
        board = score_all(system, solve(system, others, search.prior), here, {}, [], null=False)
        first = board.gain - penalty * np.array([_freedom(c.group) for c in board.all()])
        for index in np.argsort(-first)[:TRIED]:
            if first[index] < NEAR * own:
                break
            group = board[index].group
            if group.label == term.group.label and group.where == term.group.where:
                continue
            group = bent(system, search.prior, others, group)
            if not search.possible(group, others):
                _forget(system, group, board[index].group)
                continue
            worth = search.losses_without([*others[:i], group, *others[i:]])[i] - penalty * _freedom(group)
            least = BETTER + SHAPELY * gain * (_shaped(group) - _shaped(term.group))
            if worth > own + least + RARE * (is_common(term.group) - is_common(group)):
                term = Term(group, term.p_value, board[index].visible)
                terms = [*terms[:i], term, *terms[i + 1 :]]
                own = worth
            else:
                _forget(system, group, board[index].group)
    return terms


def reshape(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Every law's shape once more, with all else in the model: it was bent before the laws beside it came in."""
    for i in range(stay, len(terms)):
        group = terms[i].group
        if not _shaped(group) or group.label == "torque_ripple":
            continue
        others = [t.group for k, t in enumerate(terms) if k != i]
        moved = bent(search.system, search.prior, others, group)
        if moved is group:
            continue
        gains = [search.losses_without([*others, g])[-1] for g in (group, moved)]
        if gains[1] > gains[0] + BETTER and search.possible(moved, others):
            terms = [*terms[:i], replace(terms[i], group=moved), *terms[i + 1 :]]
        else:
            search.system.remove(moved)
    return terms


def simplify(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Takes the simpler law where what the larger adds to it is not drawn as the larger has it.

    A joint whose torque is off by a constant, with some curve of its angle beside, is no spring.
    """
    system = search.system
    for i in range(stay, len(terms)):
        group = terms[i].group
        if group.law is None or not group.law.within:
            continue
        smaller = next((g for g in search.groups if _contains(group, g)), None)
        if smaller is None:
            continue
        selected = [t.group for t in terms]
        others = [*selected[:i], *selected[i + 1 :]]
        if any(key_of(g) == key_of(smaller) for g in others):
            continue
        added = search.losses_without(selected)[i] - search.losses_without([*others, smaller])[-1]
        curves = [g for g in system.groups if g.law is None and g.joint == group.joint]
        beyond = score_all(system, solve(system, selected, search.prior), curves, {}, [], null=False)
        sure = beyond.score > np.log10(len(curves) / LEVEL)
        if sure.any() and np.max((beyond.gain - beyond.sizes)[sure]) > SHADOW * added:
            terms = [*terms[:i], replace(terms[i], group=smaller), *terms[i + 1 :]]
    return terms


def _contains(larger: Group, smaller: Group) -> bool:
    law = larger.law
    return bool(law and law.within and smaller.label == law.within and smaller.joint == larger.joint)


def relocate(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Every event's times once more, with all else in the model."""
    for i in range(stay, len(terms)):
        group = terms[i].group
        if group.law is None or not group.law.windowed:
            continue
        base = next((g for g in search.windows if g.law is group.law), None)
        if base is None:
            continue
        others = [t.group for k, t in enumerate(terms) if k != i]
        near = Candidate(base, base.size, terms[i].visible, _blocks_of(search.system, group))
        moved = located(search.system, search.prior, others, near, group.law.key == "contact")
        moved = _inside_a_window(search, others, moved)
        gains = [search.losses_without([*others, g])[-1] for g in (group, moved)]
        if moved.where == group.where or gains[1] < gains[0] + BETTER:
            search.system.remove(moved)
        else:
            terms = [*terms[:i], replace(terms[i], group=moved), *terms[i + 1 :]]
    return terms


def _forget(system: System, tried: Group, grid: Group) -> None:
    """A law bent from the grid that earned no place."""
    if tried is not grid:
        system.remove(tried)


def _inside_a_window(search: Search, others: list[Group], event: Group) -> Group:
    """The event with its times moved into the middle of a window of samples, where that fits better."""
    system, law = search.system, event.law
    if system.samples.points == 1 or law is None:
        return event
    best = search.losses_without([*others, event])[-1]
    for name in ("from_s", "to_s"):
        for share in (-0.5, 0.5):
            if name not in event.where:
                continue
            where = {**event.where, name: event.where[name] + share * system.samples.step}
            columns = system.samples.pool(law.columns(system.samples.state, where, event.shape))
            tried = system.append(replace(event, where=where), columns)
            gain = search.losses_without([*others, tried])[-1]
            if gain > best + BETTER:
                event, best = tried, gain
                break
            system.remove(tried)
    return event


def merge(terms: list[Term], stay: int = 0) -> list[Term]:
    """One of two events where both are at the same time: the second only mends the first one's edges."""
    out: list[Term] = []
    for i, term in enumerate(terms):
        again = i >= stay and any(_at_once(term.group, t.group) for t in out)
        if not again:
            out.append(term)
    return out


def _at_once(one: Group, other: Group) -> bool:
    if one.law is None or one.law is not other.law or not one.law.windowed:
        return False
    spans = [(g.where["from_s"], g.where.get("to_s", np.inf)) for g in (one, other)]
    starts, ends = np.array(spans).T
    if np.isinf(ends).any():
        return bool(np.ptp(starts) < SAME_TIME)
    common = ends.min() - starts.max()
    return bool(common > OVERLAP * (ends.max() - starts.min()))


def _blocks_of(system: System, group: Group) -> tuple[int, int]:
    """Edges of blocks nearest to an event's times."""
    t = system.samples.t
    at = np.concatenate([t[system.edges[:-1]], t[-1:]])
    first = int(np.argmin(np.abs(at - group.where["from_s"])))
    last = int(np.argmin(np.abs(at - group.where["to_s"]))) if "to_s" in group.where else len(at) - 1
    return min(first, len(at) - 2), max(last, first + 1)


def _freedom(group: Group) -> int:
    """Parameters of a law, its shape counted."""
    assert group.law is not None
    return len(group.law.linear) + sum(name in group.law.shape_bounds for name in group.shape)


def _shaped(group: Group) -> bool:
    return group.law is not None and any(name in group.law.shape_bounds for name in group.shape)
