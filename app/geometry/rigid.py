"""The rigid motion that carries one set of points onto another."""

from __future__ import annotations

import numpy as np

from app.errors import DegenerateGeometryError
from app.geometry.pose import Pose
from app.geometry.rotation import nearest_rotation


def fit_rigid(points_b: np.ndarray, points_a: np.ndarray) -> Pose:
    """T_a_b that minimises the sum of |a_i - T_a_b b_i|^2.

    Args:
        points_b: (n, 3) [m].
        points_a: (n, 3) [m], row i the same point as row i of `points_b`.

    Raises:
        DegenerateGeometryError: fewer than three points, or all on one line.

    Source: Arun, Huang, Blostein (1987), eq. (11).
    """
    b, a = np.asarray(points_b, float), np.asarray(points_a, float)
    if len(b) < 3:
        raise DegenerateGeometryError(
            f"a rigid motion needs 3 points, got {len(b)}", rank=len(b), needed=3, code="too_few"
        )
    centre_b, centre_a = b.mean(axis=0), a.mean(axis=0)
    covariance = (a - centre_a).T @ (b - centre_b)  # (3, 3)
    spread = np.linalg.svd(b - centre_b, compute_uv=False)
    if spread[1] < 1e-9 * max(spread[0], 1e-12):
        raise DegenerateGeometryError(
            "the points lie on one line: the turn about it is open",
            rank=2,
            needed=3,
            advice="add a point off the line",
        )
    rotation = nearest_rotation(covariance)
    return Pose.of(rotation, centre_a - rotation @ centre_b)
