"""The order-free estimator: tool point and touched point in one least-squares fit.

    minimise sum_i |R_i t + p_i - s|^2  over t, s
    s = mean(R) t + mean(p)
    (n I - n Rm^T Rm) t = -sum (R_i - Rm)^T (p_i - pm)          Rm, pm: means

Rotations make the normal matrix a 3x3 that needs no sum of squares; it is solved in closed form, one problem or
a hundred thousand at once.
"""

from __future__ import annotations

import numpy as np

from app.calibration.solvers.point_fit import PointFit, refuse_one_axis, refuse_too_few


def solve_joint(rotations: np.ndarray, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tool point and touched point, nothing else; no checks.

    Args:
        rotations: (..., n, 3, 3) of the flange in base; leading axes are separate problems.
        positions: (..., n, 3) [m].

    Returns:
        tool (..., 3) in the flange [m], touched (..., 3) in base [m]; not finite where a problem is singular.
    """
    if rotations.ndim == 3:
        return _solve_one(rotations, positions)
    count = rotations.shape[-3]
    mean_r, mean_p = rotations.mean(axis=-3), positions.mean(axis=-2)
    centred = positions - mean_p[..., None, :]
    # One pass as a product of (3) x (3n) and (3n): sum_i R_i^T (p_i - pm).
    rows = rotations.reshape(*rotations.shape[:-3], 3 * count, 3)
    rhs = -(centred.reshape(*centred.shape[:-2], 1, 3 * count) @ rows)[..., 0, :]
    product = np.swapaxes(mean_r, -1, -2) @ mean_r
    a = count * (1.0 - product[..., 0, 0])
    b = -count * product[..., 0, 1]
    c = -count * product[..., 0, 2]
    d = count * (1.0 - product[..., 1, 1])
    e = -count * product[..., 1, 2]
    f = count * (1.0 - product[..., 2, 2])
    # Cofactors of the symmetric matrix [[a b c] [b d e] [c e f]].
    k00, k01, k02 = d * f - e * e, c * e - b * f, b * e - c * d
    k11, k12, k22 = a * f - c * c, b * c - a * e, a * d - b * b
    r0, r1, r2 = rhs[..., 0], rhs[..., 1], rhs[..., 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = 1.0 / (a * k00 + b * k01 + c * k02)
        tool = np.stack(
            [
                (k00 * r0 + k01 * r1 + k02 * r2) * inverse,
                (k01 * r0 + k11 * r1 + k12 * r2) * inverse,
                (k02 * r0 + k12 * r1 + k22 * r2) * inverse,
            ],
            axis=-1,
        )
    touched = (mean_r @ tool[..., None])[..., 0] + mean_p
    return tool, touched


def _solve_one(rotations: np.ndarray, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    count = len(positions)
    rows = rotations.reshape(3 * count, 3)
    mean_r = np.add.reduce(rotations) / count
    mean_p = np.add.reduce(positions) / count
    product = mean_r.T @ mean_r
    ((a, b, c), (_, d, e), (_, _, f)) = product.tolist()
    a, b, c, d, e, f = (
        count * (1.0 - a),
        -count * b,
        -count * c,
        count * (1.0 - d),
        -count * e,
        count * (1.0 - f),
    )
    r0, r1, r2 = ((mean_p - positions).reshape(-1) @ rows).tolist()
    k00, k01, k02 = d * f - e * e, c * e - b * f, b * e - c * d
    k11, k12, k22 = a * f - c * c, b * c - a * e, a * d - b * b
    determinant = a * k00 + b * k01 + c * k02
    if determinant == 0.0:
        return np.full(3, np.nan), np.full(3, np.nan)
    tool = np.array(
        [
            (k00 * r0 + k01 * r1 + k02 * r2) / determinant,
            (k01 * r0 + k11 * r1 + k12 * r2) / determinant,
            (k02 * r0 + k12 * r1 + k22 * r2) / determinant,
        ]
    )
    return tool, mean_r @ tool + mean_p


def fit_joint(rotations: np.ndarray, positions: np.ndarray, *, least: float = 0.0) -> PointFit:
    """The same with checks, residuals and covariance.

    Args:
        rotations: (n, 3, 3).
        positions: (n, 3) [m].
        least: angular spread [rad] that cannot be told from none.

    Raises:
        TooFewPointsError: fewer than three touches.
        DegenerateGeometryError: rotations about one axis, or none.
    """
    refuse_too_few(len(positions))
    values, directions = refuse_one_axis(rotations, least)
    tool, touched = _solve_one(rotations, positions)
    residuals = rotations @ tool + positions - touched
    inverse = (directions.T / values**2) @ directions
    gains = -inverse @ np.swapaxes(rotations - rotations.mean(axis=0), 1, 2)
    dof = 3 * len(positions) - 6
    return PointFit(
        tool,
        touched,
        residuals,
        gains,
        float(values[0] / values[-1]),
        float(np.sqrt(np.sum(residuals**2) / dof)),
        np.ones(len(positions)),
    )
