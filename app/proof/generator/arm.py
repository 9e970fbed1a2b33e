"""The arm as plain arrays, and where its links are."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from app.proof.generator.rotations import cross, times, turn, turn_vector

PARALLEL = 1e-6  # sine of the angle below which two axes count as parallel


@dataclass(frozen=True, eq=False)
class Arm:
    """A serial arm of n joints.

    Args:
        name: of the robot.
        rotations: (n+1, 3, 3) orientation of joint k's frame in link k (the last: of the flange in link n).
        translations: (n+1, 3) [m] its place there.
        axes: (n, 3) unit direction of each joint in its own frame.
        slides: (n,) True for prismatic joints.
        lower, upper, speed, effort: (n,) limits.
        masses: (n,) [kg] of the link behind each joint, fixed attachments included.
        coms: (n, 3) [m] centres of mass, in the link's frame.
        inertias: (n, 3, 3) [kg m^2] about the centres, axes of the link's frame.
    """

    name: str
    rotations: np.ndarray
    translations: np.ndarray
    axes: np.ndarray
    slides: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    speed: np.ndarray
    effort: np.ndarray
    masses: np.ndarray
    coms: np.ndarray
    inertias: np.ndarray

    @property
    def n(self) -> int:
        return len(self.axes)

    def changed(self, **arrays) -> Arm:
        return replace(self, **arrays)


@dataclass(frozen=True, eq=False)
class Stance:
    """Where everything is at m rows, in the base frame.

    Args:
        rotations: (m, n, 3, 3) of each link's frame, after its joint moved.
        places: (m, n, 3) [m] its origin.
        axes: (m, n, 3) direction of each joint.
        flange_rotations: (m, 3, 3).
        flange_places: (m, 3) [m].
    """

    rotations: np.ndarray
    places: np.ndarray
    axes: np.ndarray
    flange_rotations: np.ndarray
    flange_places: np.ndarray


def stance(
    arm: Arm, q: np.ndarray, shifts: np.ndarray | None = None, turns: np.ndarray | None = None
) -> Stance:
    """Carries every frame outward.

    Args:
        q: (m, n) [rad or m].
        shifts: (n+1, 3) or (m, n+1, 3) [m], added to the translations, axes of the link before.
        turns: the same shapes, rotation vectors [rad], applied before the rotations, axes of the link before.
    """
    m, n = q.shape
    rotation, place = np.tile(np.eye(3), (m, 1, 1)), np.zeros((m, 3))
    rotations, places, axes = np.empty((m, n, 3, 3)), np.empty((m, n, 3)), np.empty((m, n, 3))
    for k in range(n + 1):
        offset = arm.translations[k] + (0.0 if shifts is None else shifts[..., k, :])
        inner = arm.rotations[k]
        if turns is not None and np.any(turns[..., k, :]):
            inner = turn_vector(turns[..., k, :]) @ inner
        place = place + np.einsum("mij,mj->mi", rotation, np.broadcast_to(offset, (m, 3)))
        rotation = times(rotation, inner)
        if k == n:
            break
        axes[:, k] = rotation @ arm.axes[k]
        if arm.slides[k]:
            place = place + axes[:, k] * q[:, k, None]
        else:
            rotation = rotation @ turn(arm.axes[k], q[:, k])
        rotations[:, k], places[:, k] = rotation, place
    return Stance(rotations, places, axes, rotation, place)


def point_jacobian(arm: Arm, where: Stance, points: np.ndarray) -> np.ndarray:
    """How points fixed to the flange move with the joints: points (m, 3) in base -> (m, 3, n) [m/rad or m/m]."""
    lever = points[:, None, :] - where.places
    columns = np.where(arm.slides[None, :, None], where.axes, cross(where.axes, lever))
    return np.swapaxes(columns, 1, 2)


@lru_cache(maxsize=256)  # asked for again and again of the same few arms
def link_axes(arm: Arm, link: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Directions x (common normal), y (next axis cross x) and z (own joint) of link 1..n, in the link's frame.

    The next axis of the last link is the flange's Z. Source: Denavit and Hartenberg (1955) for x and z,
    Hayati and Mirmirani (1985) for the turn about y between axes that are parallel.
    """
    z = arm.axes[link - 1]
    following = arm.axes[link] if link < arm.n else np.array([0.0, 0.0, 1.0])
    after = arm.rotations[link] @ following
    reach = arm.translations[link]
    normal = np.cross(z, after)
    if np.linalg.norm(normal) > PARALLEL:
        x = normal / np.linalg.norm(normal)
        x = -x if x @ reach < -1e-9 else x
    else:
        across = reach - (reach @ z) * z
        if np.linalg.norm(across) < 1e-9:
            across = np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))])
        x = across / np.linalg.norm(across)
    return x, np.cross(after, x), z
