"""Error on rows that were left out, without fitting anew: everything from inner products."""

from __future__ import annotations

import numpy as np

FOLDS = 10
BLOCKS = 5
KEPT = -1  # the fold of rows that are never left out
_RIDGE = 1e-6  # relative to unit columns: directions the other folds hardly saw are not blown up


def interleaved(pose: np.ndarray) -> np.ndarray:
    """(m,) fold of each row: poses dealt out in turn, repeats of one pose together."""
    order = np.unique(pose, return_index=True)[1]
    rank = np.empty(len(order), int)
    rank[np.argsort(order, kind="stable")] = np.arange(len(order))
    return rank[pose] % FOLDS


def blocks(rows: int) -> np.ndarray:
    """(m,) fold of each row: consecutive stretches of the recording."""
    return (np.arange(rows) * BLOCKS) // rows


def heldout_squares(
    jacobian: np.ndarray, white: np.ndarray, fold: np.ndarray, rows: int, counted: np.ndarray | None = None
) -> tuple[float, int]:
    """Sum of squared held-out errors of the linear model, and how many components it counts.

    Components whose prediction rests on something the other folds never saw (a target touched only in this one)
    are not counted.

    Args:
        jacobian: (N, p) whitened.
        white: (N,) what it is to explain.
        fold: (m,) number of each row's fold.
        rows: m.
        counted: (N,) components whose error is summed; by default all.
    """
    per_row = len(white) // rows
    scale = np.sqrt(np.einsum("np,np->p", jacobian, jacobian))
    scaled = jacobian / np.where(scale > 0, scale, 1.0)
    gram, right = scaled.T @ scaled, scaled.T @ white
    folds = np.repeat(fold, per_row)
    total, count = 0.0, 0
    for f in np.unique(fold[fold != KEPT]):
        out = folds == f
        block, rest = scaled[out], white[out]
        part = block.T @ block
        left = gram - part
        seen = np.diag(left) > 1e-9
        unseen = np.abs(block[:, ~seen]).max(axis=1, initial=0.0) > 0
        trained = left[np.ix_(seen, seen)] + _RIDGE * np.eye(int(seen.sum()))
        try:
            values = np.linalg.solve(trained, (right - block.T @ rest)[seen])
        except np.linalg.LinAlgError:
            continue
        error = rest - block[:, seen] @ values
        used = ~unseen & np.any(block != 0.0, axis=1)
        if counted is not None:
            used &= counted[out]
        total += float(error[used] @ error[used])
        count += int(used.sum())
    return total, count


def heldout_loss(
    jacobian: np.ndarray, white: np.ndarray, pose: np.ndarray, ghosts: int = 0
) -> tuple[float, float]:
    """Mean squared held-out error in interleaved and in time-block folds, whitened."""
    rows = len(pose) + ghosts
    out = []
    for fold in (interleaved(pose), blocks(len(pose))):
        fold = np.concatenate([fold, np.full(ghosts, KEPT)])
        total, count = heldout_squares(jacobian, white, fold, rows)
        out.append(total / max(count, 1))
    return out[0], out[1]
