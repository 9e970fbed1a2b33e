"""What was taken one by one, looked at again together: a better law in a place, an event at a better time."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.motion.bending import bent
from app.diagnosis.motion.locate import located
from app.diagnosis.motion.scoring import Candidate, score_all, solve
from app.diagnosis.motion.search import LEVEL, Term, key_of
from app.diagnosis.motion.system import Group, System

if TYPE_CHECKING:
    from app.diagnosis.motion.search import Search

PASSES = 3
TRIED = 4  # laws bent in one place
NEAR = 0.8  # of what is there must a law explain before its shape is bent: shapes lie close on the grid
SHADOW = 0.05  # of what a law adds to a simpler one within it, beyond which a free curve shows it is another
SHAPELY = 0.03  # share of its gain by which a law with a shape must beat one without
BETTER = 2.0  # an exchange must be worth this much
#: Dry and viscous friction are in every joint: another law in their place must be a hundred times likelier.
RARE = 9.2


def refine(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Exchanges laws and moves events until nothing changes; the first `stay` terms stay as they are."""
    for _ in range(PASSES):
        before = [t.group for t in terms]
        terms = simplify(search, exchange(search, relocate(search, terms, stay), stay), stay)
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
        here = [
            g for g in search.groups if g.joint == term.group.joint and not g.base and key_of(g) not in taken
        ]
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
            if worth > own + least + RARE * (_common(term.group) - _common(group)):
                term = Term(group, term.p_value, board[index].visible)
                terms = [*terms[:i], term, *terms[i + 1 :]]
                own = worth
            else:
                _forget(system, group, board[index].group)
    return terms


def simplify(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Takes the simpler law where what the larger adds to it is not drawn as the larger has it.

    A joint whose torque is off by a constant, with some curve of its angle beside, is no spring.
    """
    system = search.system
    for i in range(stay, len(terms)):
        group = terms[i].group
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


def _common(group: Group) -> bool:
    return group.law is not None and group.law.common
