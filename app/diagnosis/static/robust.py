"""Whole poses that do not belong: rejected by their own size against the others, never by extra columns."""

from __future__ import annotations

import numpy as np
from scipy import special

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.score import basis

LIMIT = 4.5  # sigma of a pose's residual
MOST = 0.15  # share of the poses that may be set aside


def outlier_rows(fitted: Fitted) -> np.ndarray:
    """(m,) True for rows whose residual is too large for the others, leverage taken into account."""
    m, k = fitted.weights.shape
    q = basis(fitted.jacobian).q[: m * k]
    leverage = np.einsum("np,np->n", q, q).reshape(m, k)
    adjusted = fitted.real / np.sqrt(np.maximum(1.0 - leverage, 0.1))
    present = fitted.weights > 0
    count = present.sum(axis=1)
    squares = np.sum(adjusted**2, axis=1)
    # The size of k Gaussian components, brought to one sigma-like number by its own median.
    free = np.maximum(count, 1)
    size = np.sqrt(squares / free)
    median = np.sqrt(2.0 * special.gammaincinv(0.5 * free, 0.5) / free)
    scale = float(np.median((size / median)[count > 0]))
    if scale <= 0:
        return np.zeros(m, bool)
    # The chance of such a size, written as the sigma of one Gaussian component.
    with np.errstate(divide="ignore"):
        log_tail = np.log(special.chdtrc(free, squares / scale**2))
    limit = special.log_ndtr(-LIMIT) + np.log(2.0)
    out = (log_tail < limit) & (count > 0)
    if out.mean() > MOST:
        worst = np.argsort(log_tail)[: int(MOST * m)]
        chosen = np.zeros(m, bool)
        chosen[worst] = True
        out &= chosen
    return out
