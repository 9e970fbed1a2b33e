"""Of very many rows an even choice: what a diagnosis learns grows with the root of their number, its time with all."""

from __future__ import annotations

import numpy as np

#: Rows a diagnosis of touches or tracker points works on; their noise averages to a hundredth then.
MOST_ROWS = 10_000
#: Touched points whose places are fitted along, and sessions with a base and a tool each: time grows with their cube.
MOST_TARGETS, MOST_SESSIONS = 150, 20
#: Samples a diagnosis of a joint log works on: its search takes 4,500 windows of them, the rest is for speeds and
#: accelerations. They come in stretches of so many samples; at either end of one these are less sure.
MOST_SAMPLES, STRETCH = 500_000, 5_000
_MANY = 50  # touches a target has where some of each may be left out; below, whole targets are


def thinned(
    keep: np.ndarray, pose: np.ndarray, target: np.ndarray | None, session: np.ndarray | None = None
) -> np.ndarray:
    """The rows that are worked on: all, or about MOST_ROWS taken evenly from beginning to end.

    Rows that repeat one pose stay together, because their scatter is the noise; so do the touches of one target where
    each has few.

    Args:
        keep: (m,) True for rows that can be used.
        pose: (m,) number of each row's pose.
        target: (m,) number of the target each row touched; None where points were measured.
        session: (m,) number of each row's session.

    Returns:
        (m,) True for those to work on.
    """
    if session is not None:
        keep = keep & _some(session, keep, MOST_SESSIONS)
    if target is not None:
        keep = keep & _some(target, keep, MOST_TARGETS)
    rows = np.flatnonzero(keep)
    if len(rows) <= MOST_ROWS:
        return keep
    units = pose if target is None else target
    if target is not None and len(rows) >= _MANY * len(np.unique(target[rows])):
        units = np.arange(len(keep))
    count = len(np.unique(units[rows]))
    return keep & _some(units, keep, max(1, round(count * MOST_ROWS / len(rows))))


def _some(units: np.ndarray, keep: np.ndarray, wanted: int) -> np.ndarray:
    """(m,) True for the rows of so many units, taken evenly as they first appear among the rows that are kept."""
    rows = np.flatnonzero(keep)
    _, first, number = np.unique(units[rows], return_index=True, return_inverse=True)
    count = len(first)
    if count <= wanted:
        return keep
    order = np.argsort(np.argsort(first))
    # One of each stretch, at a place that is drawn: a fixed step would meet what comes back at that step only.
    places = (np.arange(wanted) + np.random.default_rng(0).random(wanted)) * (count / wanted)
    chosen = np.zeros(count, bool)
    chosen[places.astype(int)] = True
    out = np.zeros(len(keep), bool)
    out[rows[chosen[order[number.reshape(-1)]]]] = True
    return out


def stretches(total: int) -> np.ndarray:
    """First samples of the stretches of a long joint log that are worked on; none where all of it is.

    One of each part of the log, at a place that is drawn: a fixed step would meet a motion that comes back at the same
    phase only. The first begins with the log, the last one ends with it.
    """
    if total <= MOST_SAMPLES:
        return np.zeros(0, int)
    count = MOST_SAMPLES // STRETCH
    edges = np.linspace(0, total, count + 1)
    share = np.random.default_rng(0).random(count)
    share[0], share[-1] = 0.0, 1.0
    return (edges[:-1] + share * (np.diff(edges) - STRETCH)).astype(int)
