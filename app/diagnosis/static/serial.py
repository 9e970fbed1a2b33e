"""Residuals that resemble their neighbours in time: chance then works in stretches, not row by row."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.score import basis, significance

_LONGEST = 0.15  # share of the poses one stretch may take
_GENEROUS = 2.0  # stretches must be longer than what they share, or neighbours still tell of each other
_LAGS = 20
#: Shares of one row's error that the next may keep.
_MEMORIES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95)


def stretch(fitted: Fitted) -> int:
    """How many poses in a row share their error: 1 + 2 sum of the autocorrelations that stand out, 1 if none."""
    values = _by_pose(fitted)
    count = len(values)
    energy = float(np.sum(values**2))
    if count < 20 or energy <= 0:
        return 1
    threshold = 2.0 / np.sqrt(count * values.shape[1])
    total = 0.0
    for lag in range(1, min(_LAGS, count // 4)):
        correlation = float(np.sum(values[lag:] * values[:-lag])) / energy
        if correlation < threshold:
            break
        total += correlation
    return (
        int(np.clip(np.ceil(_GENEROUS * (1.0 + 2.0 * total)), 1, max(1, int(_LONGEST * count))))
        if total
        else 1
    )


def _by_pose(fitted: Fitted) -> np.ndarray:
    """(p, k) mean whitened residual of every pose, in the order of their first row."""
    pose = fitted.recording.pose
    first, group = np.unique(pose, return_index=True, return_inverse=True)[1:]
    sums = np.zeros((len(first), fitted.real.shape[1]))
    np.add.at(sums, group, fitted.real)
    means = sums / np.bincount(group)[:, None]
    return means[np.argsort(first, kind="stable")]


def stretch_flips(rng: np.random.Generator, pose: np.ndarray, count: int, length: int) -> np.ndarray:
    """(m, count) of -1 and 1: one sign a stretch of `length` poses, stretches cut anew for every column."""
    first, group = np.unique(pose, return_index=True, return_inverse=True)[1:]
    rank = np.empty(len(first), int)
    rank[np.argsort(first, kind="stable")] = np.arange(len(first))
    place = rank[group]
    offset = rng.integers(0, length, count)
    block = (place[:, None] + offset) // length
    signs = rng.integers(0, 2, (int(block.max()) + 1, count)) * 2.0 - 1.0
    return np.take_along_axis(signs, block, axis=0)


def coloured_score(fitted: Fitted, index: int) -> float:
    """-log10 p of term `index` where every error may be a share of the one before it, whatever that share is.

    A step or a drift looks like errors that remember, and the other way round; so each side of the test may choose
    its own memory. A row's errors are `e[i] = memory e[i-1] + fresh`; the best sums of squares of the fresh parts
    with the term and without are compared. Where errors remember nothing this is the plain F test.

    Source: generalised least squares with first-order autoregressive errors, profile likelihood
    (Cochrane and Orcutt 1949; Beach and MacKinnon 1978 for the first row).
    """
    where = fitted.slices[index]
    jacobian = np.delete(fitted.jacobian, where, axis=1)
    own = fitted.jacobian[:, where]
    white = fitted.white + own @ fitted.terms[index].values
    # Base and tool first, the term, what is to be explained: sums of squares with and without are read off one factor.
    stacked = np.column_stack([basis(jacobian).q, own, white])
    free = stacked.shape[1] - own.shape[1] - 1
    now, lagged, ghost = _lagged(fitted, stacked)
    same, cross, old, fixed = now.T @ now, now.T @ lagged, lagged.T @ lagged, ghost.T @ ghost
    first = _first_rows(fitted, stacked)
    head = first.T @ first
    n = fitted.size
    blocks = max(len(first) // fitted.real.shape[1], 1) * fitted.real.shape[1]
    best = [np.inf, np.inf]
    for memory in _MEMORIES:
        gram = same - memory * (cross + cross.T) + memory**2 * old + (1.0 - memory**2) * head + fixed
        price = -blocks * np.log(1.0 - memory**2)
        for which, count in enumerate((free, free + own.shape[1])):
            rss = _left(gram, count)
            best[which] = min(best[which], n * np.log(rss / n) + price)
    gain = -float(np.expm1(min(best[1] - best[0], 0.0) / n))
    dof = max(n - free, 2)
    return float(significance(np.array(gain), 1.0, own.shape[1], dof))


def _lagged(fitted: Fitted, stacked: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows that have one before them in their session, those before them, and the ghosts, components side by side."""
    m, k = fitted.weights.shape
    session = fitted.recording.session
    follows = np.flatnonzero(session[1:] == session[:-1]) + 1
    rows = stacked[: m * k].reshape(m, k, -1)
    width = stacked.shape[1]
    return rows[follows].reshape(-1, width), rows[follows - 1].reshape(-1, width), stacked[m * k :]


def _first_rows(fitted: Fitted, stacked: np.ndarray) -> np.ndarray:
    """The rows with which a session begins."""
    m, k = fitted.weights.shape
    session = fitted.recording.session
    first = np.concatenate([[0], np.flatnonzero(session[1:] != session[:-1]) + 1])
    return stacked[: m * k].reshape(m, k, -1)[first].reshape(-1, stacked.shape[1])


def _left(gram: np.ndarray, count: int) -> float:
    """Sum of squares of the last column that the first `count` leave."""
    a, b, c = gram[:count, :count], gram[:count, -1], float(gram[-1, -1])
    scale = 1.0 / np.sqrt(np.maximum(np.diag(a), 1e-300))
    solved = np.linalg.lstsq(a * scale[:, None] * scale, b * scale, rcond=1e-10)[0]
    return max(c - float((b * scale) @ solved), 1e-300)
