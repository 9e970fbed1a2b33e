"""When an event begins and ends, finer than the blocks of the search."""

from __future__ import annotations

import numpy as np

from app.diagnosis.motion.scoring import Candidate, solve
from app.diagnosis.motion.system import Group, System, windowed

STEPS = 24  # places tried across two blocks


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
    pieces = []
    for j, part in enumerate(system.parts):
        if base.joint is not None and base.joint != j:
            continue
        col, pos = solution.columns[j], solution.positions[j]
        z = part.columns[:, col]
        pieces.append(
            (part.columns[:, part.places[base]], part.columns[:, 0] - z @ solution.theta[pos], z, pos)
        )
    count = len(t)
    for _ in range(2):
        low = _best(_around(low, edges, first, count), pieces, solution.covariance, lambda x, h=high: (x, h))
        if ends:
            high = _best(
                _around(high, edges, last, count), pieces, solution.covariance, lambda x, lo=low: (lo, x)
            )
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


def _best(places: np.ndarray, pieces, inverse: np.ndarray, window) -> int:
    gains = []
    for place in places:
        a, b = window(int(place))
        if b - a < 3:
            gains.append(-np.inf)
            continue
        k = pieces[0][0].shape[1]
        D, E, s = np.zeros((k, k)), np.zeros((k, len(inverse))), np.zeros(k)
        for c, r, z, pos in pieces:
            cut = c[a:b]
            D += cut.T @ cut
            s += cut.T @ r[a:b]
            E[:, pos] += cut.T @ z[a:b]
        M = D - E @ inverse @ E.T
        M[np.diag_indices_from(M)] += 1e-9 * np.trace(M) / k + 1e-300
        gains.append(float(s @ np.linalg.solve(M, s)))
    return int(places[int(np.argmax(gains))])
