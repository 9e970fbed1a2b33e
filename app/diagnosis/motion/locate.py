"""When an event begins and ends, finer than the blocks of the search."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from app.diagnosis.motion.scoring import Candidate, solve
from app.diagnosis.motion.system import Group, System, windowed

STEPS = 24  # places tried across two blocks
SHORTEST = 3  # samples of a window

#: One joint's whitened columns of the event, of the model, and residual (k + p + 1, M); where the model's stand.
Piece = tuple[np.ndarray, np.ndarray]


def located(
    system: System, prior: np.ndarray, selected: list[Group], candidate: Candidate, ends: bool
) -> Group:
    """The window's group with its edges moved to where the fit is best; registered with the system.

    Args:
        ends: True where the window has an end; else it lasts to the end of the log.
    """
    assert candidate.window is not None
    base = candidate.group
    first, last = candidate.window
    t, edges = system.samples.t, system.edges
    low, high = int(edges[first]), int(edges[last])
    solution = solve(system, selected, prior)
    pieces: list[Piece] = []
    for j, part in enumerate(system.parts):
        if base.joint is not None and base.joint != j:
            continue
        col, pos = solution.columns[j], solution.positions[j]
        place = part.places[base]
        rows = part.columns.T[np.concatenate([np.arange(place.start, place.stop), col])]
        pieces.append((np.vstack([rows, part.residual(col, solution.theta[pos])]), pos))
    count = len(t)
    for _ in range(2):
        low = _best(_around(low, edges, first, count), high, pieces, solution.covariance)
        if ends:
            high = _best(_around(high, edges, last, count), low, pieces, solution.covariance, after=True)
    times = {"from_s": _edge(t, low)}
    if ends:
        times["to_s"] = _edge(t, high)
    group = windowed(base, **times)
    state = system.samples.state
    assert group.law is not None
    return system.append(group, system.samples.pool(group.law.columns(state, group.where, group.shape)))


def _edge(t: np.ndarray, index: int) -> float:
    if index <= 0:
        return float(t[0])
    if index >= len(t):
        return float(t[-1] + (t[-1] - t[-2]))
    return float(0.5 * (t[index - 1] + t[index]))


def _around(at: int, edges: np.ndarray, block: int, count: int) -> np.ndarray:
    low, high = edges[max(block - 1, 0)], edges[min(block + 1, len(edges) - 1)]
    places = np.unique(np.linspace(low, high, STEPS).astype(int))
    near = np.unique(np.clip(at + np.arange(-6, 7), 0, count))
    return np.union1d(places, near)


def _best(
    places: np.ndarray, fixed: int, pieces: list[Piece], inverse: np.ndarray, *, after: bool = False
) -> int:
    """The place from which on, up to sample `fixed`, the window fits best; `after`: the place up to which.

    Args:
        places: rising.
        inverse: (p, p) covariance of the model's unknowns.
    """
    possible = places[places >= fixed + SHORTEST] if after else places[places <= fixed - SHORTEST]
    if not len(possible):
        return int(places[0])
    edges = [fixed, *possible.tolist()] if after else [*possible.tolist(), fixed]
    k = len(pieces[0][0]) - 1 - len(pieces[0][1])
    D, s = np.zeros((len(possible), k, k)), np.zeros((len(possible), k, 1))
    E = np.zeros((len(possible), k, len(inverse)))
    for rows, pos in pieces:
        # From place to place once; every window is a sum of neighbours.
        between = np.array([rows[:k, a:b] @ rows[:, a:b].T for a, b in pairwise(edges)])
        sums = np.cumsum(between, axis=0) if after else np.cumsum(between[::-1], axis=0)[::-1]
        D += sums[:, :, :k]
        E[:, :, pos] += sums[:, :, k:-1]
        s += sums[:, :, -1:]
    M = D - (E.reshape(-1, len(inverse)) @ inverse).reshape(E.shape) @ np.swapaxes(E, 1, 2)
    trace = np.trace(M, axis1=1, axis2=2)
    M += (1e-9 * trace / k + 1e-300)[:, None, None] * np.eye(k)
    gains = np.sum(s * np.linalg.solve(M, s), axis=(1, 2))
    return int(possible[int(np.argmax(gains))])
