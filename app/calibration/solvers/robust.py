"""As the joint estimator, but a touch that lies far off counts less. None is dropped; the weights are reported.

Iteratively reweighted least squares with Huber's weights on the distance of each tip from the touched point. The
scale is the median distance. With few touches one that is off draws the fit to itself until all lie equally far;
there each touch is judged by a fit of the others, and where they exclude exactly one, their own noise is the scale.
Three touches cannot exclude one.

Source: Huber (1964); Holland and Welsch (1977).
"""

from __future__ import annotations

import numpy as np
from scipy import special

from app.calibration.solvers.joint import fit_joint, solve_joint
from app.calibration.solvers.point_fit import PointFit

#: Distances up to this many scales count in full: 95% efficient for a distance in three dimensions.
TURNING = 1.7
#: Median length of a three-dimensional normal vector with unit noise on each axis.
_MEDIAN_LENGTH = 1.5382
_STEPS = 50
#: Up to so many touches each is judged by the others first; with more the median distance shows who is off.
FEW = 6
#: The others exclude a touch that lies so far from their point that this happens once in 1/EXCLUDED sets.
EXCLUDED = 0.05
#: Noise of a touch below this [m] is not believed.
_FINEST = 1e-6


def fit_robust(rotations: np.ndarray, positions: np.ndarray, *, least: float = 0.0) -> PointFit:
    """Arguments and errors as `fit_joint`; `weights` say what each touch counted."""
    start = fit_joint(rotations, positions, least=least)
    n = len(positions)
    rows = np.concatenate([rotations, -np.broadcast_to(np.eye(3), (n, 3, 3))], axis=2)  # (n, 3, 6)
    lengths = np.linalg.norm(start.residuals, axis=1)
    weights, solution = np.ones(n), np.r_[start.tool, start.touched]
    fixed = _noise_of_the_others(rotations, positions)
    for _ in range(_STEPS):
        scale = fixed or float(np.median(lengths)) / _MEDIAN_LENGTH * np.sqrt(n / max(n - 2.0, 1.0))
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


def _noise_of_the_others(rotations: np.ndarray, positions: np.ndarray) -> float | None:
    """One-sigma of the touches [m] where all but one agree and exclude that one; None where that cannot be told.

    For each touch i: the others' fit with SSE_i on 3 (n - 1) - 6 degrees of freedom, and by how much the sum falls
    without it, SSE - SSE_i on 3. Their ratio has Fisher's distribution where no touch is off.
    """
    n = len(positions)
    if not 4 <= n <= FEW:
        return None
    keep = ~np.eye(n, dtype=bool)
    rest_r = np.array([rotations[k] for k in keep])
    rest_p = np.array([positions[k] for k in keep])
    tools, touched = solve_joint(rest_r, rest_p)
    if not np.isfinite(tools).all():
        return None
    apart = np.einsum("knij,kj->kni", rest_r, tools) + rest_p - touched[:, None, :]
    without = np.sum(apart**2, axis=(1, 2))  # (n,)
    tool, point = solve_joint(rotations, positions)
    whole = float(np.sum((rotations @ tool + positions - point) ** 2))
    dof = 3 * (n - 1) - 6
    best = int(np.argmin(without))
    # Numbers written with few digits may agree by chance; rounding to a micrometre is no noise.
    noise = max(float(np.sqrt(without[best] / dof)), _FINEST)
    ratio = (whole - without[best]) / 3.0 / noise**2
    return noise if special.fdtrc(3, dof, ratio) * n < EXCLUDED else None
