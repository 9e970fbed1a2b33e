"""Cells drawn at random with their truth: a base anywhere, an arm of any size, arcs as a tracker would see them.

Written from the geometry alone, without the solver's code: a point is turned about an axis by Rodrigues' formula.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Cells:
    """m cells: points (m, n, 3) [m] with noise, their one-sigma (m, n), and the true frames (m, 4, 4)."""

    first: np.ndarray
    second: np.ndarray
    sigma_first: np.ndarray
    sigma_second: np.ndarray
    truth: np.ndarray
    towards: np.ndarray


def random_rotations(rng, count):
    """Uniform over all rotations, (count, 3, 3)."""
    q = rng.normal(size=(count, 4))
    w, x, y, z = (q / np.linalg.norm(q, axis=1, keepdims=True)).T
    return np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
            np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
            np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1),
        ],
        -2,
    )


def turned(points, axis, angles):
    """Points (m, 3) turned about a line through the origin along axis (m, 3) by angles (m, n) -> (m, n, 3)."""
    p, k = points[:, None, :], axis[:, None, :]
    c, s = np.cos(angles)[..., None], np.sin(angles)[..., None]
    along = np.sum(k * p, axis=-1, keepdims=True)
    return c * p + s * np.cross(np.broadcast_to(k, p.shape), p) + (1 - c) * along * k


def random_cells(seed, count, *, points=36, meeting=0.2, square=0.0, noise=15e-6, noise_per_m=6e-6):
    """Cells with arcs of 90 to 330 degrees.

    Args:
        meeting: share of cells whose axes meet.
        square: one-sigma deviation from a right angle between the axes [rad].
    """
    rng = np.random.default_rng(seed)
    rotation, origin = random_rotations(rng, count), rng.uniform(-4, 4, (count, 3))
    truth = np.zeros((count, 4, 4))
    truth[:, :3, :3], truth[:, :3, 3], truth[:, 3, 3] = rotation, origin, 1.0
    offset = rng.uniform(0.05, 0.5, count) * (rng.random(count) >= meeting)
    tilt = rng.normal(0, square, count) if square else np.zeros(count)
    z = np.tile([0.0, 0.0, 1.0], (count, 1))
    y = np.stack([np.zeros(count), np.cos(tilt), np.sin(tilt)], -1)
    shoulder = np.stack([offset, np.zeros(count), np.zeros(count)], -1)
    reflector = np.stack(
        [rng.uniform(0.8, 2.5, count), rng.uniform(-0.3, 0.3, count), rng.uniform(-0.5, 1.5, count)], -1
    )
    spans = np.radians(rng.uniform([90, 90], [330, 200], (count, 2)))
    grid = np.linspace(-0.5, 0.5, points)
    first = turned(reflector, z, spans[:, :1] * grid)
    second = turned(reflector - shoulder, y, spans[:, 1:] * (grid - 0.1)) + shoulder[:, None, :]
    seen = []
    for local in (first, second):
        world = np.einsum("mij,mnj->mni", rotation, local) + origin[:, None, :]
        sigma = noise + noise_per_m * np.linalg.norm(world, axis=-1)
        seen += [world + rng.normal(size=world.shape) * sigma[..., None], sigma]
    towards = origin + 1.5 * rotation[:, :, 0]
    return Cells(seen[0], seen[2], seen[1], seen[3], truth, towards)
