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
    theta = solved(whole - A, right - g, prior)
    loss = yy - 2 * np.sum(g * theta, 1) + np.sum(theta * (A @ theta[:, :, None])[:, :, 0], 1)
    return np.array([loss[:FOLDS].sum(), loss[FOLDS:].sum()])


def solved(A: np.ndarray, g: np.ndarray, prior: np.ndarray) -> np.ndarray:
    """(..., p) unknowns from normal equations (..., p, p) and (..., p), the prior's information added to the
    leading ones."""
    i, size = len(prior), A.shape[-1]
    A = A.copy()
    A[..., :i, :i] += prior
    scale = np.sqrt(np.maximum(np.diagonal(A, axis1=-2, axis2=-1), 0.0))  # sums that cancel leave rounding
    # What is not excited stays zero.
    scale = np.where(scale <= 1e-9 * scale.max(-1, keepdims=True), np.inf, scale)
    A /= scale[..., None, :]
    A /= scale[..., None]
    A[..., np.arange(size), np.arange(size)] += np.where(np.isinf(scale), 1.0, 1e-11)
    return np.linalg.solve(A, (g / scale)[..., None])[..., 0] / scale
