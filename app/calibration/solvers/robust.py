"""As the joint estimator, but a touch that lies far off counts less. None is dropped; the weights are reported.

Iteratively reweighted least squares with Huber's weights on the distance of each tip from the touched point. The
scale is the median distance; three or four touches have too little redundancy to tell which one is off, so weights
stay near one there.

Source: Huber (1964); Holland and Welsch (1977).
"""

from __future__ import annotations

import numpy as np

from app.calibration.solvers.joint import fit_joint
from app.calibration.solvers.point_fit import PointFit

#: Distances up to this many scales count in full: 95% efficient for a distance in three dimensions.
TURNING = 1.7
#: Median length of a three-dimensional normal vector with unit noise on each axis.
_MEDIAN_LENGTH = 1.5382
_STEPS = 50


def fit_robust(rotations: np.ndarray, positions: np.ndarray, *, least: float = 0.0) -> PointFit:
    """Arguments and errors as `fit_joint`; `weights` say what each touch counted."""
    start = fit_joint(rotations, positions, least=least)
    n = len(positions)
    rows = np.concatenate([rotations, -np.broadcast_to(np.eye(3), (n, 3, 3))], axis=2)  # (n, 3, 6)
    lengths = np.linalg.norm(start.residuals, axis=1)
    weights, solution = np.ones(n), np.r_[start.tool, start.touched]
    for _ in range(_STEPS):
        scale = float(np.median(lengths)) / _MEDIAN_LENGTH * np.sqrt(n / max(n - 2.0, 1.0))
        if scale < 1e-12:
            break
        new = np.minimum(1.0, TURNING * scale / np.maximum(lengths, 1e-15))
        if np.abs(new - weights).max() < 1e-6:
            break
        weights = new
        root = np.sqrt(weights)[:, None, None]
        solution = np.linalg.lstsq(
            (root * rows).reshape(-1, 6), -(root[:, :, 0] * positions).reshape(-1), rcond=None
        )[0]
        lengths = np.linalg.norm(rows @ solution + positions, axis=1)
    residuals = rows @ solution + positions
    normal = np.einsum("n,nij,nik->jk", weights, rows, rows)
    gains = -(np.linalg.inv(normal) @ np.swapaxes(weights[:, None, None] * rows, 1, 2))[:, :3]
    # The share that counts in full corrects for what the weights take out of the sum (Huber 1981, eq. 7.6.2).
    full = max(float(np.mean(weights > 0.999)), 1.0 / n)
    sigma = float(np.sqrt(np.sum((weights[:, None] * residuals) ** 2) / (3 * n - 6))) / full
    return PointFit(solution[:3], solution[3:], residuals, gains, start.condition, sigma, weights)
