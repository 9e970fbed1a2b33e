"""Residuals that resemble their neighbours in time: chance then works in stretches, not row by row."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.fit import Fitted

_LONGEST = 0.15  # share of the poses one stretch may take
_GENEROUS = 2.0  # stretches must be longer than what they share, or neighbours still tell of each other
_LAGS = 20


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
