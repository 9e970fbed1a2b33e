"""Linear least squares with rank, condition and covariance."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.estimation.fit import Fit

RANK_TOLERANCE = 1e-10  # relative to the largest singular value of the column-scaled matrix


def covariance_from_jacobian(jacobian: np.ndarray, sigma: float) -> tuple[np.ndarray, int, float]:
    """sigma^2 (J^T J)^-1, the rank and the condition of J; columns are scaled to unit length first.

    Directions that are not determined get infinite variance on every parameter they touch.

    Args:
        jacobian: (m, p).
        sigma: one-sigma noise of a residual.

    Returns:
        covariance (p, p), rank, condition.
    """
    p = jacobian.shape[1]
    if p == 0:
        return np.zeros((0, 0)), 0, 1.0
    scale = np.linalg.norm(jacobian, axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    _, s, vt = np.linalg.svd(jacobian / scale, full_matrices=False)
    full = np.zeros(p)
    full[: len(s)] = s
    top = full[0] if full[0] > 0 else 1.0
    keep = full > RANK_TOLERANCE * top
    rank = int(keep.sum())
    rows = vt[: len(s)][keep[: len(s)]]
    half = rows / full[keep][:, None] / scale  # (rank, p)
    covariance = sigma**2 * half.T @ half
    if rank < p:
        seen = np.sum(rows**2, axis=0)  # share of each parameter inside the determined space
        lost = seen < 1.0 - 1e-9
        covariance[lost, :] = covariance[:, lost] = 0.0
        covariance[lost, lost] = np.inf
    condition = float(full[0] / full[-1]) if rank == p and full[-1] > 0 else float("inf")
    return covariance, rank, condition


def solve_linear(
    matrix: np.ndarray,
    rhs: np.ndarray,
    *,
    names: Sequence[str],
    units: Sequence[str],
    sigma: float | None = None,
) -> Fit:
    """Least-squares solution of `matrix @ x = rhs`; the minimum-norm one where the rank is short.

    Args:
        matrix: (m, p).
        rhs: (m,).
        sigma: stated one-sigma noise of `rhs`; None estimates it from what is left over.
    """
    scale = np.linalg.norm(matrix, axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    solution, _, _, _ = np.linalg.lstsq(matrix / scale, rhs, rcond=RANK_TOLERANCE)
    values = solution / scale
    residuals = rhs - matrix @ values
    _, rank, _ = covariance_from_jacobian(matrix, 1.0)
    dof = len(rhs) - rank
    source = "stated"
    if sigma is None:
        source = "residual"
        sigma = float(np.sqrt(residuals @ residuals / dof)) if dof > 0 else float("nan")
    covariance, rank, condition = covariance_from_jacobian(matrix, sigma)
    return Fit(tuple(names), tuple(units), values, covariance, residuals, dof, sigma, source, rank, condition)
