"""A joint's friction chosen as a set.

Dry, viscous and quadratic friction, the bump near standstill and what fades as a joint warms up draw much the same
curves. Taken one by one, the second bends to mend the first: a bump of the wrong speed on quadratic friction stands
where dry and viscous friction belong, or friction that warms up for ever where dry friction does, and no single
exchange leads out of it. The sets are few, so each is tried, one law's speed or time being scanned.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.motion.scoring import LEAST_VISIBLE, solve
from app.diagnosis.motion.search import Term, dear, is_common, key_of, resists
from app.diagnosis.motion.system import Group

if TYPE_CHECKING:
    from app.diagnosis.effects.motion._state import State
    from app.diagnosis.motion.search import Search

BETTER = 2.0  # another set must be worth this much
#: Dry and viscous friction are in every joint: another law in their place must be a hundred times likelier.
RARE = 9.2
AROUND = (0.5, 3.0)  # times the lowest and the highest shape of the search's own grid: so far it is scanned
FARTHEST = 0.1  # of the logarithm: from one shape of the scan to the next
STEP = 1e-3
TRIED = 8  # shapes of a family looked at, the best first


@dataclass(frozen=True, eq=False)
class _Scan:
    """One joint's friction laws, all else projected off.

    Args:
        groups: laws, each at every shape it is tried with.
        places: their columns; of a law with a shape, the second is its slope in the logarithm of the shape,
            so that between two speeds of the scan nothing is lost.
        raw: (c,) squared lengths of the columns; matrix (c, c), right (c,) projected.
        own: so many leading groups are those there are now.
    """

    groups: list[Group]
    places: list[list[int]]
    raw: np.ndarray
    matrix: np.ndarray
    right: np.ndarray
    own: int

    def fits(self, fixed: list[int], scanned: list[int]) -> tuple[np.ndarray, np.ndarray]:
        """Falls of the whitened sum of squares (s,) and coefficients (s, p) of some laws with each of the scanned.

        Args:
            scanned: one law at several shapes; empty where only the fixed ones are fitted (s is then 1).
        """
        base = [c for k in fixed for c in self.places[k]]
        at = np.array([[*base, *self.places[k]] for k in scanned] if scanned else [base])
        M, right = self.matrix[at[:, :, None], at[:, None]], self.right[at]
        scale = np.sqrt(np.maximum(np.diagonal(M, axis1=1, axis2=2), 1e-300))
        M = M / scale[:, :, None] / scale[:, None] + 1e-9 * np.eye(at.shape[1])
        values = np.linalg.solve(M, (right / scale)[..., None])[..., 0] / scale
        return np.sum(values * right, axis=1), values


def choose_friction(search: Search, terms: list[Term], stay: int = 0) -> list[Term]:
    """Puts the best set of friction laws on every joint that has more than dry and viscous friction.

    Args:
        stay: so many leading terms are left as they are.
    """
    rare = {t.group.joint for t in terms[stay:] if resists(t.group) and not is_common(t.group)}
    for joint in sorted(j for j in rare if j is not None):
        terms = _joint(search, terms, stay, joint)
    return terms


def _joint(search: Search, terms: list[Term], stay: int, joint: int) -> list[Term]:
    here = [i for i, t in enumerate(terms) if i >= stay and t.group.joint == joint and resists(t.group)]
    others = [t.group for i, t in enumerate(terms) if i not in here]
    scan = _scan(search, others, [terms[i].group for i in here], joint)
    own = list(range(len(here)))
    best = _Choice(_best(search, scan, own, []).worth + BETTER, own, [])
    for fixed, scanned in _families(scan.groups, len(own)):
        best = max(best, _best(search, scan, fixed, scanned), key=lambda choice: choice.worth)
    chosen = best.laws
    if chosen == own:
        return terms
    keep = {scan.groups[k].label: terms[i] for k, i in zip(own, here, strict=True)}
    weakest = max((terms[i] for i in here), key=lambda t: t.p_value)
    fresh = []
    for k, values in zip(chosen, best.values, strict=True):
        group, first = scan.groups[k], scan.places[k][0]
        if _bends(group):
            group = _registered(search, group, values)
        visible = float(np.sqrt(np.clip(scan.matrix[first, first] / max(scan.raw[first], 1e-300), 0.0, 1.0)))
        fresh.append(Term(group, keep.get(group.label, weakest).p_value, visible))
    left = [t for i, t in enumerate(terms) if i not in here]
    at = here[0]
    return [*left[:at], *fresh, *left[at:]]


def _scan(search: Search, others: list[Group], own: list[Group], joint: int) -> _Scan:
    """The laws there are now first, then every law that may be there, at every shape."""
    system = search.system
    part, whitener, samples = system.parts[joint], system.whiteners[joint], system.samples
    taken = {key_of(g) for g in others[search.known :]}
    groups = list(own)
    taken |= {key_of(g) for g in own if not _bends(g)}
    grids: dict[tuple, list[Group]] = {}
    for group in search.groups:
        if group.joint == joint and resists(group) and key_of(group) not in taken:
            grids.setdefault(key_of(group), []).append(group)
    for grid in grids.values():
        groups += _scanned(grid)
    columns = [whitener(samples.pool(_columns(samples.state, g))) for g in groups]
    ends = np.cumsum([0, *(c.shape[1] for c in columns)])
    places = [list(range(a, b)) for a, b in pairwise(ends.tolist())]
    C = np.concatenate(columns, axis=1)
    solution = solve(system, others, search.prior)
    col, pos = solution.columns[joint], solution.positions[joint]
    z = part.columns[:, col]
    cross = C.T @ z
    whole = C.T @ C
    right = C.T @ (part.columns[:, 0] - z @ solution.theta[pos])
    matrix = whole - cross @ solution.covariance[np.ix_(pos, pos)] @ cross.T
    return _Scan(groups, places, np.diag(whole), matrix, right, len(own))


def _scanned(grid: list[Group]) -> list[Group]:
    """A law at every shape from below its grid to above it; as it is where it has none to bend."""
    law, name = grid[0].law, _bends(grid[0])
    if law is None or not name:
        return grid[:1]
    values = [g.shape[name] for g in grid]
    low, high = np.clip((AROUND[0] * min(values), AROUND[1] * max(values)), *law.shape_bounds[name])
    count = int(np.log(high / low) / FARTHEST) + 2
    return [replace(grid[0], shape={**grid[0].shape, name: float(v)}) for v in np.geomspace(low, high, count)]


def _bends(group: Group) -> str:
    """The shape that may bend, "" where there is none."""
    return next((n for n in group.shape if group.law is not None and n in group.law.shape_bounds), "")


def _families(groups: list[Group], own: int) -> list[tuple[list[int], list[int]]]:
    """Every choice of laws, each law once: those as they are, and at most one that is scanned over its shapes.

    Args:
        own: so many leading groups are those there are now.
    """
    by_label: dict[str, list[int]] = {}
    for k, group in enumerate(groups):
        by_label.setdefault(group.label, []).append(k)
    out: list[tuple[list[int], list[int]]] = [([], [])]
    for places in by_label.values():
        still = [k for k in places if k < own or not _bends(groups[k])]
        moving = [k for k in places if k not in still]
        more = [([*fixed, k], scanned) for fixed, scanned in out for k in still]
        if moving:
            more += [(fixed, moving) for fixed, scanned in out if not scanned]
        out += more
    return out[1:]


@dataclass(frozen=True, eq=False)
class _Choice:
    """Laws, what they are worth, and each one's coefficients."""

    worth: float
    laws: list[int]
    values: list[np.ndarray]


def _best(search: Search, scan: _Scan, fixed: list[int], scanned: list[int]) -> _Choice:
    """The best of a family: gain less what its parameters cost; worth minus infinity where an arm cannot have it."""
    gains, values = scan.fits(fixed, scanned)
    together = [scan.groups[k] for k in [*fixed, *scanned[:1]]]
    penalty = np.log(max(search.system.rows, 3)) * values.shape[1]
    cost = penalty + sum(dear(g, together) + RARE * (not is_common(g)) for g in together)
    for index in np.argsort(-gains)[:TRIED]:
        laws = [*fixed, *scanned[index : index + 1]]
        ends = np.cumsum([len(scan.places[k]) for k in laws])[:-1]
        parts = np.split(values[index], ends)
        if all(_possible(search, scan, k, part) for k, part in zip(laws, parts, strict=True)):
            return _Choice(float(gains[index] - cost), laws, parts)
    return _Choice(-np.inf, [], [])


def _possible(search: Search, scan: _Scan, k: int, values: np.ndarray) -> bool:
    """True where the log shows the law, its slope is good for its step, and an arm can have its values."""
    group, first = scan.groups[k], scan.places[k][0]
    if scan.matrix[first, first] < LEAST_VISIBLE**2 * scan.raw[first]:
        return False
    if k >= scan.own and len(values) > 1 and abs(values[1]) > 2 * FARTHEST * abs(values[0]):
        return False
    law = group.law
    return search.change or (law is not None and law.lawful(law.values(values[:1], group.shape)))


def _columns(state: State, group: Group) -> np.ndarray:
    """(m, 1), or (m, 2) with the slope in the logarithm of the shape."""
    law, name = group.law, _bends(group)
    assert law is not None
    columns = law.columns(state, group.where, group.shape)
    if not name:
        return columns
    up, down = (
        law.columns(state, group.where, {**group.shape, name: group.shape[name] * np.exp(step)})
        for step in (STEP, -STEP)
    )
    return np.concatenate([columns, (up - down) / (2 * STEP)], axis=1)


def _registered(search: Search, group: Group, values: np.ndarray) -> Group:
    """The group at the shape that its slope asks for, among the system's columns."""
    samples, law = search.system.samples, group.law
    assert law is not None
    name = _bends(group)
    step = float(np.clip(values[1] / values[0], -2 * FARTHEST, 2 * FARTHEST))
    value = float(np.clip(group.shape[name] * np.exp(step), *law.shape_bounds[name]))
    shape = {**group.shape, name: value}
    group = replace(group, shape=shape, size=1, bent=False)
    return search.system.append(group, samples.pool(law.columns(samples.state, group.where, shape)))
