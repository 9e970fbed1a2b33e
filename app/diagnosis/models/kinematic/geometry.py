"""Directions of a link's geometry: along the axis (d), along the common normal (a), and the turns about them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.kinematics import Chain

AXES = ("d", "a", "alpha", "beta")
_PARALLEL = 1e-6  # sine of the angle between two axes below which they have no single common normal
#: m: axes that pass each other closer than this cross; x is then z times the next axis, whatever rounding says.
_CROSSING = 1e-6


@dataclass(frozen=True, eq=False)
class LinkAxes:
    """Unit vectors of every link's geometry, in the frame of the *next* placement (joint k+1, last: flange).

    Args:
        vectors: (n, 4, 3) in the order of `AXES`; the first two shift, the last two turn.
        lengths: (n, 3) [m] the link's own vector, in the same frame.
        parallel: (n,) True where the axes at the link's two ends are parallel.
    """

    vectors: np.ndarray
    lengths: np.ndarray
    parallel: np.ndarray


def link_axes(chain: Chain) -> LinkAxes:
    """d: along joint k's axis z. a, alpha: along x, the common normal of the axes k and k+1. beta: y = z' x x.

    x points from the first to the second; where they cross it is z times the next axis, and where they coincide
    any perpendicular serves.
    The last link's next axis is the flange's Z.

    Source: Denavit, Hartenberg (1955); Hayati (1983) for beta.
    """
    n = chain.joint_count
    vectors, lengths, parallel = np.empty((n, 4, 3)), np.empty((n, 3)), np.zeros(n, bool)
    for k in range(n):
        last = k == n - 1
        rotation = chain.flange_rotation if last else chain.rotations[k + 1]
        translation = chain.flange_translation if last else chain.translations[k + 1]
        z = chain.axes[k]
        following = rotation @ (np.array([0.0, 0.0, 1.0]) if last else chain.axes[k + 1])
        x = np.cross(z, following)
        parallel[k] = np.linalg.norm(x) < _PARALLEL
        if parallel[k]:
            x = translation - (translation @ z) * z
        if np.linalg.norm(x) < _PARALLEL:
            x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
        x = x / np.linalg.norm(x)
        if x @ translation < -_CROSSING:
            x = -x
        y = np.cross(following, x)
        vectors[k] = np.stack([z, x, x, y]) @ rotation  # into the next placement's frame
        lengths[k] = translation @ rotation
    return LinkAxes(vectors, lengths, parallel)
