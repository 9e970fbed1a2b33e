"""How far values may be off: the posterior's covariance where errors have heavy tails, and hang together in time."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.regression.evidence import Posterior, Selection
from app.diagnosis.thresholds.rows import OUTLIER_WEIGHT, ROBUST_DOF

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.library import Linear


def as_errors_are(posterior: Posterior, linear: Linear, selection: Selection, rows: np.ndarray) -> Posterior:
    """The posterior with the covariance that its weights have under errors as they were found.

    Estimates w = M^-1 X'y with M = X'X + Gamma^-1 miss by M^-1 (X'e - Gamma^-1 w), so that their covariance is

        sigma^2 M^-1 (k X'RX + Gamma^-1) M^-1

    R: correlation of errors, a first-order autoregression from row to row; k: what weighing rows by a t distribution
    costs. Both are one for normal errors that do not hang together.
    Source: Huber, "Robust Statistics" (1981), 7.6 for k.

    Args:
        rows: (m,) robust weight of each row.
    """
    if not len(posterior.columns):
        return posterior
    design = linear.design
    gamma = np.zeros(design.size)
    for g, width in selection.items():
        gamma[linear.groups[g].columns] += width
    per_row = design.left(posterior.columns, posterior.weights).reshape(len(rows), -1)
    memory = memory_of(per_row)
    gram = design.matrix[np.ix_(posterior.columns, posterior.columns)]
    if memory > 0:
        gram = _remembered(design.explicit(posterior.columns), memory, len(rows))
    meat = _tails(per_row, rows) * gram
    prior = np.diag(1.0 / gamma[posterior.columns])
    inverse = posterior.covariance / posterior.variance
    covariance = posterior.variance * inverse @ (meat + prior) @ inverse
    return replace(posterior, covariance=0.5 * (covariance + covariance.T))


def memory_of(left: np.ndarray) -> float:
    """Correlation of a residual (m, k) with the row before, 0 where it is not beyond chance.

    From successive differences, which a step in the residual hardly disturbs: their correlation at lag one is
    -(1 - r) / 2 for a first-order autoregression.
    """
    steps = np.diff(left, axis=0)
    size = float(np.sum(steps[1:] ** 2))
    if size <= 0.0:
        return 0.0
    memory = 1.0 + 2.0 * float(np.sum(steps[1:] * steps[:-1])) / size
    chance = 2.0 / np.sqrt(steps.size)
    return float(np.clip(memory if memory > chance else 0.0, 0.0, 0.95))


def _remembered(columns: np.ndarray, memory: float, rows: int) -> np.ndarray:
    """X'RX with R = memory^|i - j| between rows, each component by itself."""
    blocks = columns.reshape(rows, -1, columns.shape[1])
    before, out = np.zeros(blocks.shape[1:]), np.zeros((columns.shape[1], columns.shape[1]))
    for block in blocks:
        before = memory * before
        out += before.T @ block
        before = before + block
    return columns.T @ columns + out + out.T


def _tails(left: np.ndarray, rows: np.ndarray) -> float:
    """Variance of weighted estimates over what the weighted sum of squares says of it.

    With w(s) = min(1, c / (nu + s)) the weight of a row of squared size s in d components and psi(r) = w r:
    E w^2 s E w / (E w s (E psi')^2).
    """
    used = rows > OUTLIER_WEIGHT
    weight = rows[used]
    if not used.any() or weight.min() >= 1.0:
        return 1.0
    weighted = np.sum(left[used] ** 2, axis=1)  # w s, in units of sigma^2
    size = weighted / weight
    count = np.maximum(np.count_nonzero(left[used], axis=1), 1)
    falling = np.where(weight < 1.0, 2.0 / count * size / (ROBUST_DOF + size), 0.0)
    slope = float(np.mean(weight * (1.0 - falling)))
    return float(np.mean(weight * weighted) * np.mean(weight) / (np.mean(weighted) * max(slope, 0.1) ** 2))
