"""A joint's friction chosen as a set.

Dry, viscous and quadratic friction and the bump near standstill draw much the same curve of speed. Taken one by
one, the second bends to mend the first: a bump of the wrong speed on quadratic friction stands where dry and viscous
friction belong, and no single exchange leads out of it. The sets are few, so each is tried with its speeds scanned.
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
SHARES = np.geomspace(0.03, 1.5, 40)  # of the joint's usual speed, scanned
FARTHEST = 0.1  # of the logarithm: from one speed of the scan to the next
STEP = 1e-3


@dataclass(frozen=True, eq=False)
class _Scan:
    """One joint's friction laws, all else projected off.

    Args:
        groups: laws, each at every shape it is tried with.
        places: their columns; of a law with a shape, the second is its slope in the logarithm of the shape,
            so that between two speeds of the scan nothing is lost.
        raw: (c,) squared lengths of the columns; matrix (c, c), right (c,) projected.
    """

    groups: list[Group]
    places: list[list[int]]
    raw: np.ndarray
    matrix: np.ndarray
    right: np.ndarray

    def fit(self, chosen: list[int]) -> tuple[float, list[np.ndarray]]:
        """Fall of the whitened sum of squares with some laws, and the coefficients of each."""
        at = [c for k in chosen for c in self.places[k]]
        M = self.matrix[np.ix_(at, at)]
        scale = np.sqrt(np.maximum(np.diag(M), 1e-300))
        M = M / scale / scale[:, None]
        M[np.diag_indices_from(M)] += 1e-9
        values = np.linalg.solve(M, self.right[at] / scale) / scale
        sizes = np.cumsum([len(self.places[k]) for k in chosen])[:-1]
        return float(values @ self.right[at]), np.split(values, sizes)


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
    best, chosen = _worth(search, scan, own) + BETTER, own
    for tried in _sets(scan.groups):
        worth = _worth(search, scan, tried)
        if worth > best:
            best, chosen = worth, tried
    if chosen == own:
        return terms
    keep = {scan.groups[k].label: terms[i] for k, i in zip(own, here, strict=True)}
    weakest = max((terms[i] for i in here), key=lambda t: t.p_value)
    fresh = []
    for k, values in zip(chosen, scan.fit(chosen)[1], strict=True):
        group, first = scan.groups[k], scan.places[k][0]
        if group.shape:
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
    groups, seen = list(own), set()
    for group in search.groups:
        law = group.law
        if group.joint != joint or not resists(group) or group.label in seen or key_of(group) in taken:
            continue
        assert law is not None
        seen.add(group.label)
        if not group.shape:
            groups.append(group)
            continue
        name = next(iter(law.shape_bounds))
        low, high = law.shape_bounds[name]
        speeds = np.clip(SHARES * samples.state.speed[joint], low, high)
        groups += [replace(group, shape={name: float(value)}) for value in speeds]
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
    return _Scan(groups, places, np.diag(whole), matrix, right)


def _sets(groups: list[Group]) -> list[list[int]]:
    """Every choice of laws, each law once."""
    by_label: dict[str, list[int]] = {}
    for k, group in enumerate(groups):
        by_label.setdefault(group.label, []).append(k)
    out: list[list[int]] = [[]]
    for places in by_label.values():
        out += [[*one, k] for one in out for k in places]
    return out[1:]


def _worth(search: Search, scan: _Scan, chosen: list[int]) -> float:
    """Gain less what its parameters cost; minus infinity where an arm cannot have its values."""
    penalty = np.log(max(search.system.rows, 3))
    if not chosen:
        return -np.inf
    worth, values = scan.fit(chosen)
    together = [scan.groups[k] for k in chosen]
    for k, value in zip(chosen, values, strict=True):
        group, first = scan.groups[k], scan.places[k][0]
        assert group.law is not None
        if scan.matrix[first, first] < LEAST_VISIBLE**2 * scan.raw[first]:
            return -np.inf
        if not search.change and not group.law.lawful(group.law.values(value[:1], group.shape)):
            return -np.inf
        worth -= penalty * (1 + len(group.shape)) + dear(group, together) + RARE * (not is_common(group))
    return worth


def _columns(state: State, group: Group) -> np.ndarray:
    """(m, 1), or (m, 2) with the slope in the logarithm of the shape."""
    law = group.law
    assert law is not None
    columns = law.columns(state, group.where, group.shape)
    if not group.shape:
        return columns
    up, down = (
        law.columns(state, group.where, {name: value * np.exp(step) for name, value in group.shape.items()})
        for step in (STEP, -STEP)
    )
    return np.concatenate([columns, (up - down) / (2 * STEP)], axis=1)


def _registered(search: Search, group: Group, values: np.ndarray) -> Group:
    """The group at the shape that its slope asks for, among the system's columns."""
    samples, law = search.system.samples, group.law
    assert law is not None
    step = float(np.clip(values[1] / values[0], -FARTHEST, FARTHEST))
    shape = {
        name: float(np.clip(v * np.exp(step), *law.shape_bounds[name])) for name, v in group.shape.items()
    }
    group = replace(group, shape=shape, size=1, bent=False)
    return search.system.append(group, samples.pool(law.columns(samples.state, group.where, shape)))
