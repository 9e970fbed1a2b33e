"""The paper's estimator: differences of neighbouring touches.

The equations, with the misprints put right (eq. 8 lacks its second transpose, eq. 9 the one on the right-hand sum):

    A t = b,  A = [R_i - R_{i+1}],  b = [p_{i+1} - p_i]                                   (6)
    t = (2 (n-1) I - sum (R_i^T R_{i+1} + R_{i+1}^T R_i))^-1 sum (R_i - R_{i+1})^T (p_{i+1} - p_i)   (9)

A touch stands in two neighbouring differences, so the answer depends on the order of the touches.

Source: Xiong, Ye, Jiang (2012), Machinery & Electronics 6, eqs. (6)-(10).
"""

from __future__ import annotations

import numpy as np

from app.calibration.solvers.joint import fit_joint
from app.calibration.solvers.point_fit import PointFit


def solve_pairwise(rotations: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Tool point by eq. (9): (n, 3, 3), (n, 3) [m] -> (3,) [m]."""
    first, second = rotations[:-1], rotations[1:]
    cross = np.einsum("nij,nik->jk", first, second)  # sum R_i^T R_{i+1}
    normal = 2.0 * len(first) * np.eye(3) - cross - cross.T
    rhs = np.einsum("nij,ni->j", first - second, positions[1:] - positions[:-1])
    return np.linalg.solve(normal, rhs)


def delta(rotations: np.ndarray, positions: np.ndarray, tool: np.ndarray) -> float:
    """Eq. (10): the norm of all neighbouring differences of the tip [m]."""
    tips = rotations @ tool + positions
    return float(np.linalg.norm(np.diff(tips, axis=0)))


def fit_pairwise(rotations: np.ndarray, positions: np.ndarray, *, least: float = 0.0) -> PointFit:
    """The paper's tool point with residuals and covariance; arguments and errors as `fit_joint`.

    The covariance is that of this estimator for independent touches (neighbouring differences are not independent);
    the noise itself is taken from the order-free fit.
    """
    fair = fit_joint(rotations, positions, least=least)
    tool = solve_pairwise(rotations, positions)
    tips = rotations @ tool + positions
    touched = tips.mean(axis=0)
    matrix = rotations[:-1] - rotations[1:]  # (n-1, 3, 3)
    stacked = matrix.reshape(-1, 3)
    inverse = np.linalg.inv(stacked.T @ stacked)
    spread = np.zeros((len(positions), 3, 3))  # A^T D: what one touch's error does to the right-hand side
    spread[:-1] += matrix
    spread[1:] -= matrix
    gains = -inverse @ np.swapaxes(spread, 1, 2)
    values = np.linalg.svd(stacked, compute_uv=False)
    return PointFit(
        tool,
        touched,
        tips - touched,
        gains,
        float(values[0] / values[-1]),
        fair.sigma,
        fair.weights,
    )
