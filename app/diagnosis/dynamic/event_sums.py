"""Products of an event's columns over rows, and the evidence that blocks of them have."""

from __future__ import annotations

import numpy as np


def between(white, parts, residual, size: int, rows: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Products of an event's columns with themselves, the selection's and the residual, over some rows."""
    d = white[0].shape[1]
    gram, cross, right = np.zeros((d, d)), np.zeros((d, size)), np.zeros(d)
    for z, (x, ids), r in zip(white, parts, residual, strict=True):
        gram += z[rows].T @ z[rows]
        cross[:, ids] += z[rows].T @ x[rows]
        right += z[rows].T @ r[rows]
    return gram, cross, right


def by_rows(
    white, parts, residual, size: int, rows: slice, stride: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same for every so many rows, (m, ...); the last ones may be fewer."""
    count, d = rows.stop - rows.start, white[0].shape[1]
    m = -(-count // stride)

    def cut(values: np.ndarray) -> np.ndarray:
        whole = np.zeros((m * stride, values.shape[1]))
        whole[:count] = values[rows]
        return whole.reshape(m, stride, values.shape[1])

    gram, cross, right = np.zeros((m, d, d)), np.zeros((m, d, size)), np.zeros((m, d))
    for z, (x, ids), r in zip(white, parts, residual, strict=True):
        own = np.swapaxes(cut(z), 1, 2)
        gram += own @ np.swapaxes(own, 1, 2)
        cross[:, :, ids] += own @ cut(x)
        right += (own @ cut(r[:, None]))[:, :, 0]
    return gram, cross, right


def gains(gram, cross, right, inverse, first, last, part: slice) -> np.ndarray:
    """Evidence of windows [first, last) of pieces, penalties not counted."""
    gram, right = gram[:, part, part], right[:, part]
    edges, d = right.shape
    sums = cross[:, part].reshape(edges * d, -1)
    taken = ((sums @ inverse) @ sums.T).reshape(edges, d, edges, d).transpose(0, 2, 1, 3)  # of any two edges
    block = gram[last] - gram[first] - taken[last, last] - taken[first, first]
    block = block + taken[first, last] + taken[last, first]
    return fits(block, right[last] - right[first])


def block_gains(block, over, own, inverse) -> np.ndarray:
    """(w,) evidence of w blocks of columns beside a selection, penalties not counted."""
    return fits(block - (over @ inverse) @ np.swapaxes(over, 1, 2), own)


def fits(block: np.ndarray, own: np.ndarray) -> np.ndarray:
    """(w,) evidence of w blocks of columns with what a selection has of them taken off, penalties not counted."""
    block = block + np.eye(block.shape[1])
    try:
        lower = np.linalg.cholesky(block)
    except np.linalg.LinAlgError:  # rounding has made one of them indefinite
        solved = np.linalg.solve(block, own[..., None])[..., 0]
        return 0.5 * np.einsum("wd,wd->w", own, solved) - 0.5 * np.linalg.slogdet(block)[1]
    size = np.diagonal(lower, axis1=1, axis2=2)
    half = np.empty_like(own)
    for k in range(own.shape[1]):  # forward substitution, all blocks at once
        half[:, k] = (own[:, k] - np.einsum("wk,wk->w", lower[:, k, :k], half[:, :k])) / size[:, k]
    return 0.5 * np.einsum("wd,wd->w", half, half) - np.log(size).sum(axis=1)
