"""Lines in space: how near two come to each other, and where."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Sine of the angle below which two lines count as parallel: their common perpendicular has no place.
PARALLEL = 1e-9


@dataclass(frozen=True, eq=False)
class Perpendicular:
    """The shortest connection of two lines, for any batch.

    Args:
        foot_1: (..., 3) [m] its end on the first line.
        foot_2: (..., 3) [m] its end on the second line.
        along_1, along_2: (...,) [m] where the feet are, counted from the lines' points along their directions.
        distance: (...,) [m], not negative.
        normal: (..., 3) unit, direction_1 x direction_2 made to length one; NaN where the lines are parallel.
        sine, cosine: (...,) of the angle from the first direction to the second.
    """

    foot_1: np.ndarray
    foot_2: np.ndarray
    along_1: np.ndarray
    along_2: np.ndarray
    distance: np.ndarray
    normal: np.ndarray
    sine: np.ndarray
    cosine: np.ndarray


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Row-wise product, (..., 3) and (..., 3) -> (...,)."""
    return np.einsum("...k,...k->...", a, b)


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross product, (..., 3) each; a fifth of numpy's time on single vectors."""
    a0, a1, a2 = a[..., 0], a[..., 1], a[..., 2]
    b0, b1, b2 = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0], axis=-1)


def common_perpendicular(
    point_1: np.ndarray, direction_1: np.ndarray, point_2: np.ndarray, direction_2: np.ndarray
) -> Perpendicular:
    """The common perpendicular of two lines given by a point and a unit direction each.

    Lines that meet have distance 0 and still a normal. Parallel lines give NaN feet and normal.

    Args:
        point_1, direction_1, point_2, direction_2: (..., 3); points in [m], directions of length one.

    Source: patent of S. China Univ. of Technology (Wang et al., 2017), step 4.2, lines L1 and L2.
    """
    normal = cross(direction_1, direction_2)
    sine = np.sqrt(dot(normal, normal))
    cosine = dot(direction_1, direction_2)
    usable = np.where(sine > PARALLEL, sine, np.nan)
    normal = normal / usable[..., None]
    between = point_2 - point_1
    # |n|^2 t1 = (between x d2) . n and the same with d1: Cramer's rule on the 2 x 2 normal equations.
    along_1 = dot(cross(between, direction_2), normal) / usable
    along_2 = dot(cross(between, direction_1), normal) / usable
    foot_1 = point_1 + along_1[..., None] * direction_1
    foot_2 = point_2 + along_2[..., None] * direction_2
    distance = np.abs(dot(between, normal))
    return Perpendicular(foot_1, foot_2, along_1, along_2, distance, normal, sine, cosine)


def distance_to_line(points: np.ndarray, point: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """How far points (..., 3) lie from the line through `point` along the unit `direction` [m]."""
    arm = points - point
    return np.linalg.norm(arm - dot(arm, direction)[..., None] * direction, axis=-1)
