"""Error on blocks of time the model has not seen."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from app.diagnosis.motion.system import Group, System

FOLDS = 5


@lru_cache(maxsize=8)
def folds(blocks: int) -> np.ndarray:
    """(2 FOLDS, blocks) True where a block is left out: every fifth one in turn, then runs of neighbours."""
    index, turn = np.arange(blocks), np.arange(FOLDS)[:, None]
    return np.concatenate([index % FOLDS == turn, index * FOLDS // blocks == turn])


def heldout_losses(system: System, selected: list[Group], prior: np.ndarray) -> np.ndarray:
    """(2,) whitened sum of squares on what was left out, for interleaved blocks and for runs."""
    left_out = folds(system.block_count)
    A, g, yy = system.normal_folds(selected, left_out)
    whole, right, _ = system.normal(selected)
    theta = np.stack([solved(whole - a, right - r, prior) for a, r in zip(A, g, strict=True)])
    loss = yy - 2 * np.sum(g * theta, 1) + np.einsum("fi,fij,fj->f", theta, A, theta, optimize=True)
    return np.array([loss[:FOLDS].sum(), loss[FOLDS:].sum()])


def solved(A: np.ndarray, g: np.ndarray, prior: np.ndarray) -> np.ndarray:
    """(p,) unknowns from normal equations (p, p), (p,), the prior's information added to the leading ones."""
    i = len(prior)
    A = A.copy()
    A[:i, :i] += prior
    scale = np.sqrt(np.maximum(np.diag(A), 0.0))  # sums that cancel leave rounding
    scale[scale <= 1e-9 * scale.max()] = np.inf  # what is not excited stays zero
    A = A / scale / scale[:, None]
    A[np.diag_indices_from(A)] += np.where(np.isinf(scale), 1.0, 1e-11)
    return np.linalg.solve(A, g / scale) / scale
