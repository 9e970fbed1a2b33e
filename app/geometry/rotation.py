"""Rotations as (..., 3, 3) matrices, rotation vectors and wxyz quaternions."""

from __future__ import annotations

import numpy as np

_SMALL = 1e-8  # below this angle [rad] the series is exact to double precision


def skew(v: np.ndarray) -> np.ndarray:
    """Cross-product matrix: skew(v) @ w = v x w.

    Args:
        v: (..., 3).

    Returns:
        (..., 3, 3).
    """
    v = np.asarray(v, float)
    out = np.zeros((*v.shape[:-1], 3, 3))
    out[..., 0, 1], out[..., 0, 2], out[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    out[..., 1, 0], out[..., 2, 0], out[..., 2, 1] = v[..., 2], -v[..., 1], v[..., 0]
    return out


def exp_so3(rotvec: np.ndarray) -> np.ndarray:
    """Rotation matrix of a rotation vector: exp([w]x) = I + sin(t)/t [w]x + (1-cos t)/t^2 [w]x^2.

    Args:
        rotvec: (..., 3) [rad].

    Returns:
        (..., 3, 3).

    Source: Rodrigues (1840).
    """
    w = np.asarray(rotvec, float)
    angle2 = np.sum(w * w, axis=-1)[..., None, None]
    angle = np.sqrt(angle2)
    small = angle < _SMALL
    safe = np.where(small, 1.0, angle)
    a = np.where(small, 1.0 - angle2 / 6.0, np.sin(safe) / safe)
    b = np.where(small, 0.5 - angle2 / 24.0, 2.0 * np.sin(safe / 2.0) ** 2 / safe**2)
    k = skew(w)
    return np.eye(3) + a * k + b * (k @ k)


def log_so3(rotation: np.ndarray) -> np.ndarray:
    """Rotation vector of a rotation matrix, angle in [0, pi]; exact near the identity and near pi.

    Args:
        rotation: (..., 3, 3).

    Returns:
        (..., 3) [rad].
    """
    q = quaternion_from_rotation(rotation)  # w >= 0, so the angle is in [0, pi]
    w, v = q[..., 0], q[..., 1:]
    norm = np.linalg.norm(v, axis=-1)
    small = norm < _SMALL
    factor = np.where(small, 2.0, 2.0 * np.arctan2(norm, w) / np.where(small, 1.0, norm))
    return factor[..., None] * v


def quaternion_from_rotation(rotation: np.ndarray) -> np.ndarray:
    """Unit quaternion (wxyz, w >= 0) of a rotation matrix.

    Args:
        rotation: (..., 3, 3).

    Returns:
        (..., 4).

    Source: Shepperd (1978): take the largest of the four components first.
    """
    r = np.asarray(rotation, float)
    m00, m11, m22 = r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]
    # 4 q q^T, built from the matrix; its largest-diagonal row is the best conditioned.
    k = np.empty((*r.shape[:-2], 4, 4))
    k[..., 0, 0], k[..., 1, 1] = 1 + m00 + m11 + m22, 1 + m00 - m11 - m22
    k[..., 2, 2], k[..., 3, 3] = 1 - m00 + m11 - m22, 1 - m00 - m11 + m22
    k[..., 0, 1] = k[..., 1, 0] = r[..., 2, 1] - r[..., 1, 2]
    k[..., 0, 2] = k[..., 2, 0] = r[..., 0, 2] - r[..., 2, 0]
    k[..., 0, 3] = k[..., 3, 0] = r[..., 1, 0] - r[..., 0, 1]
    k[..., 1, 2] = k[..., 2, 1] = r[..., 0, 1] + r[..., 1, 0]
    k[..., 1, 3] = k[..., 3, 1] = r[..., 0, 2] + r[..., 2, 0]
    k[..., 2, 3] = k[..., 3, 2] = r[..., 1, 2] + r[..., 2, 1]
    best = np.argmax(np.diagonal(k, axis1=-2, axis2=-1), axis=-1)
    q = np.take_along_axis(k, best[..., None, None], axis=-2)[..., 0, :]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    return np.where(q[..., :1] < 0, -q, q)


def rotation_from_quaternion(wxyz: np.ndarray) -> np.ndarray:
    """Rotation matrix of a quaternion (wxyz), which is normalised first.

    Args:
        wxyz: (..., 4), not all zero.

    Returns:
        (..., 3, 3).
    """
    q = np.asarray(wxyz, float)
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    w, v = q[..., :1, None], q[..., 1:]
    k = skew(v)
    return np.eye(3) + 2.0 * (w * k + k @ k)


def _about(axis: int, angle) -> np.ndarray:
    angle = np.asarray(angle, float)
    c, s = np.cos(angle), np.sin(angle)
    second, third = (axis + 1) % 3, (axis + 2) % 3
    out = np.zeros((*angle.shape, 3, 3))
    out[..., axis, axis] = 1.0
    out[..., second, second] = out[..., third, third] = c
    out[..., second, third], out[..., third, second] = -s, s
    return out


def rot_x(angle) -> np.ndarray:
    """Rotation about X by `angle` [rad], any batch shape -> (..., 3, 3)."""
    return _about(0, angle)


def rot_y(angle) -> np.ndarray:
    """Rotation about Y by `angle` [rad], any batch shape -> (..., 3, 3)."""
    return _about(1, angle)


def rot_z(angle) -> np.ndarray:
    """Rotation about Z by `angle` [rad], any batch shape -> (..., 3, 3)."""
    return _about(2, angle)


def angle_between(rotation_a: np.ndarray, rotation_b: np.ndarray) -> np.ndarray:
    """Angle [rad] that turns a into b; (..., 3, 3) each -> (...)."""
    relative = np.swapaxes(rotation_a, -1, -2) @ rotation_b
    return np.linalg.norm(log_so3(relative), axis=-1)


def nearest_rotation(matrix: np.ndarray) -> np.ndarray:
    """The rotation nearest to a matrix in the Frobenius norm; (..., 3, 3).

    Source: Arun, Huang, Blostein (1987): U diag(1, 1, det) V^T.
    """
    u, _, vt = np.linalg.svd(matrix)
    u[..., :, 2] *= np.linalg.det(u @ vt)[..., None]
    return u @ vt
