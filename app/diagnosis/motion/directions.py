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
    inverse, good = inverse_factors(matrices)
    # The largest eigenvalue of the inverse is no more than their sum.
    whole = possible & good & (np.einsum("cij,cij->c", inverse, inverse) * least < 1.0)
    inverse[~whole] = 0.0
    done, count = inverse @ blocks, np.where(whole, size, 0)
    if len(rest := np.flatnonzero(possible & ~whole)):
        values, vectors = np.linalg.eigh(matrices[rest])
        keep = values > least
        half = np.swapaxes(vectors, 1, 2) / np.sqrt(np.where(keep, values, np.inf))[:, :, None]
        done[rest], count[rest] = half @ blocks[rest], keep.sum(1)
    return done, count


def inverse_factors(matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """L^-1 of the Cholesky factors of many small matrices (c, k, k), and (c,) False where there is none."""
    count, size = matrices.shape[:2]
    rest = np.moveaxis(matrices, 0, 2).copy()  # (k, k, c): what is left of each matrix
    out, good = np.zeros((size, size, count)), np.ones(count, bool)
    out[range(size), range(size)] = 1.0
    for j in range(size):  # Gaussian elimination without exchanges, on the matrix and on the identity
        pivot = rest[j, j]
        good &= pivot > 0
        pivot = np.where(good, pivot, 1.0)
        for i in range(j + 1, size):
            factor = np.where(good, rest[i, j], 0.0) / pivot  # what is none would grow without bounds
            rest[i, j:] -= factor * rest[j, j:]
            out[i, : j + 1] -= factor * out[j, : j + 1]
        out[j, : j + 1] /= np.sqrt(pivot)
    return np.ascontiguousarray(np.moveaxis(out, 2, 0)), good
