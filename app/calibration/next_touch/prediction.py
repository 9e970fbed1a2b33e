"""What touches of given orientations will tell about the tool point; positions and results do not enter.

covariance = noise^2 (n I - n Rm^T Rm)^-1,    Rm the mean of the n flange rotations
"""

from __future__ import annotations

import numpy as np

from app.estimation import reach
from app.units import from_mm

#: One-sigma noise of a touch on one axis before any is known [m]: a careful hand.
USUAL_NOISE = from_mm(0.3)
_SINGULAR = 1e-12
_UPPER = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


def information(total: np.ndarray, count: int) -> np.ndarray:
    """n I - S^T S / n for the sum S of n rotations; (..., 3, 3) -> (..., 3, 3)."""
    return count * np.eye(3) - np.swapaxes(total, -1, -2) @ total / count


def predicted_covariance(rotations: np.ndarray, noise: float = USUAL_NOISE) -> np.ndarray:
    """(3, 3) of the tool point in the flange [m^2]; infinite while it is not determined.

    Args:
        rotations: (n, 3, 3) of the flange, made or planned.
        noise: one-sigma of one touch on one axis [m].
    """
    count = len(rotations)
    if count >= 3:
        matrix = information(np.sum(rotations, axis=0), count)
        if np.linalg.eigvalsh(matrix)[0] > _SINGULAR:
            return noise**2 * np.linalg.inv(matrix)
    return np.diag(np.full(3, np.inf))


def predicted_error(rotations: np.ndarray, noise: float = USUAL_NOISE) -> float:
    """Longest half axis of the region that holds the tool point in 95 of 100 cases [m]; inf while it is not determined.

    The same figure as a result's (quality/region.py), with the noise known beforehand.
    """
    covariance = predicted_covariance(rotations, noise)
    if not np.isfinite(covariance).all():
        return float("inf")
    return reach(0) * float(np.sqrt(np.linalg.eigvalsh(covariance)[-1]))


def with_another(sums: np.ndarray, rotations: np.ndarray, count: int) -> np.ndarray:
    """(6, k, m) information with each of m rotations added to each of k sums; rows 11, 12, 13, 22, 23, 33 of 3 x 3.

    (S + R)^T (S + R) is S^T S + I and a part linear in R, which one product gives for all.

    Args:
        sums: (k, 3, 3) of count - 1 rotations each.
        rotations: (m, 3, 3).
        count: rotations in all, the added one included.
    """
    linear = np.zeros((6, len(sums), 3, 3))
    for entries, (i, j) in zip(linear, _UPPER, strict=True):
        entries[:, :, j] += sums[:, :, i]
        entries[:, :, i] += sums[:, :, j]
    squared = np.swapaxes(sums, 1, 2) @ sums
    fixed = np.stack([(count - 1.0 / count) * (i == j) - squared[:, i, j] / count for i, j in _UPPER])
    return fixed[:, :, None] - linear.reshape(6, -1, 9) @ (rotations.reshape(-1, 9).T / count)


def inverse_trace(upper: np.ndarray, faint: float = 0.0) -> np.ndarray:
    """trace((M + faint I)^-1) of symmetric matrices in closed form; huge where singular.

    Args:
        upper: (6, ...) their entries 11, 12, 13, 22, 23, 33.
        faint: added to the diagonal.
    """
    a, b, c, d, e, f = upper
    a, d, f = a + faint, d + faint, f + faint
    first, second, third = d * f - e * e, b * f - c * e, b * e - c * d
    determinant = a * first - b * second + c * third
    sums = first + a * f - c * c + a * d - b * b
    return np.where(determinant > _SINGULAR, sums / np.maximum(determinant, _SINGULAR), 1e12)
