"""Many small symmetric matrices at once: directions of a candidate's columns that show, and what they gain.

A candidate whose directions all show, as nearly all do, needs no eigenvalues.
"""

from __future__ import annotations

import numpy as np


def halved(
    matrices: np.ndarray, blocks: np.ndarray, least: float, possible: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Rows whose squares add up to block^T matrix^-1 block, in directions that show.

    Args:
        matrices: (c, k, k) symmetric.
        blocks: (c, k, B).
        least: eigenvalues above it show.
        possible: (c,) False where nothing does.

    Returns:
        (c, k, B) rows, zeros where a direction does not show; (c,) how many do.
    """
    size = matrices.shape[1]
    whole = possible & lower(matrices - least * np.eye(size))[1]  # all eigenvalues are above
    done, count = np.zeros_like(blocks), np.where(whole, size, 0)
    at = np.flatnonzero(whole)
    factor, left = lower(matrices[at])[0], blocks[at]
    for i in range(size):
        for k in range(i):
            left[:, i] -= factor[:, i, k, None] * left[:, k]
        left[:, i] /= factor[:, i, i, None]
    done[at] = left
    if len(rest := np.flatnonzero(possible & ~whole)) and size > 1:
        values, vectors = np.linalg.eigh(matrices[rest])
        keep = values > least
        half = np.swapaxes(vectors, 1, 2) / np.sqrt(np.where(keep, values, np.inf))[:, :, None]
        done[rest], count[rest] = half @ blocks[rest], keep.sum(1)
    return done, count


def lower(matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cholesky factors (c, k, k) of many small matrices, and (c,) False where one is not positive definite."""
    out, good = np.zeros_like(matrices), np.ones(len(matrices), bool)
    for j in range(matrices.shape[1]):
        column = matrices[:, j:, j] - np.matmul(out[:, j:, :j], out[:, j, :j, None])[:, :, 0]
        good &= column[:, 0] > 0
        column[~good] = 0.0  # what is none grows without bounds
        out[:, j:, j] = column / np.sqrt(np.where(good, column[:, 0], 1.0))[:, None]
    return out, good
