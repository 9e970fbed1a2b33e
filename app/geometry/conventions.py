"""How makers write an orientation: one table.

Every convention turns three angles (or four quaternion components) into the rotation R_base_flange and
back. Internally only rotation matrices and wxyz quaternions exist.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.errors import UnknownNameError
from app.geometry.rotation import (
    exp_so3,
    log_so3,
    quaternion_from_rotation,
    rot_x,
    rot_y,
    rot_z,
    rotation_from_quaternion,
)

_GIMBAL = 1e-9  # cosine below which two of the three angles turn about the same axis


@dataclass(frozen=True)
class AngleConvention:
    """One way to write an orientation.

    Args:
        key: the name used in files (`# angles: KEY`).
        title: what it says on a screen, with its formula.
        columns: column names, without unit.
        makers: who writes it so.
        angular: True where the components are angles; False for a quaternion.
        to_rotation: (..., k) [rad] -> (..., 3, 3).
        from_rotation: (..., 3, 3) -> (..., k) [rad].
    """

    key: str
    title: str
    columns: tuple[str, ...]
    makers: tuple[str, ...]
    angular: bool
    to_rotation: Callable[[np.ndarray], np.ndarray]
    from_rotation: Callable[[np.ndarray], np.ndarray]


def _zyx_to(a: np.ndarray) -> np.ndarray:
    return rot_z(a[..., 0]) @ rot_y(a[..., 1]) @ rot_x(a[..., 2])


def _zyx_from(r: np.ndarray) -> np.ndarray:
    cos_b = np.hypot(r[..., 0, 0], r[..., 1, 0])
    b = np.arctan2(-r[..., 2, 0], cos_b)
    locked = cos_b < _GIMBAL  # only A -/+ C is determined: put all of it into A
    a = np.where(locked, np.arctan2(-r[..., 0, 1], r[..., 1, 1]), np.arctan2(r[..., 1, 0], r[..., 0, 0]))
    # C from what is left after A is taken out, Rz(-A) R: near the lock A alone is noise, but C makes up for it.
    sin_a, cos_a = np.sin(a), np.cos(a)
    left = sin_a * r[..., 0, 2] - cos_a * r[..., 1, 2], cos_a * r[..., 1, 1] - sin_a * r[..., 0, 1]
    c = np.where(locked, 0.0, np.arctan2(*left))
    return np.stack([a, b, c], axis=-1)


def _zyz_to(a: np.ndarray) -> np.ndarray:
    return rot_z(a[..., 0]) @ rot_y(a[..., 1]) @ rot_z(a[..., 2])


def _zyz_from(r: np.ndarray) -> np.ndarray:
    sin_b = np.hypot(r[..., 0, 2], r[..., 1, 2])
    b = np.arctan2(sin_b, r[..., 2, 2])
    locked = sin_b < _GIMBAL
    up = np.where(r[..., 2, 2] > 0, 1.0, -1.0)
    a = np.where(
        locked,
        np.arctan2(up * r[..., 1, 0], up * r[..., 0, 0]),
        np.arctan2(r[..., 1, 2], r[..., 0, 2]),
    )
    sin_a, cos_a = np.sin(a), np.cos(a)  # as above: c makes up for what is noise in a
    left = cos_a * r[..., 1, 0] - sin_a * r[..., 0, 0], cos_a * r[..., 1, 1] - sin_a * r[..., 0, 1]
    c = np.where(locked, 0.0, np.arctan2(*left))
    return np.stack([a, b, c], axis=-1)


def _xyz_fixed_to(a: np.ndarray) -> np.ndarray:
    return _zyx_to(a[..., ::-1])


def _xyz_fixed_from(r: np.ndarray) -> np.ndarray:
    return _zyx_from(r)[..., ::-1]


CONVENTIONS: dict[str, AngleConvention] = {
    c.key: c
    for c in (
        AngleConvention(
            "ZYX",
            "A, B, C: R = Rz(A) Ry(B) Rx(C)",
            ("a", "b", "c"),
            ("KUKA", "Xiong 2012 eq. (19)"),
            True,
            _zyx_to,
            _zyx_from,
        ),
        AngleConvention(
            "ZYZ",
            "O, A, T: R = Rz(a) Ry(b) Rz(c)",
            ("a", "b", "c"),
            ("Kawasaki", "Stäubli (older)"),
            True,
            _zyz_to,
            _zyz_from,
        ),
        AngleConvention(
            "XYZ",
            "W, P, R about fixed axes: R = Rz(c) Ry(b) Rx(a)",
            ("a", "b", "c"),
            ("FANUC", "Yaskawa", "URDF rpy"),
            True,
            _xyz_fixed_to,
            _xyz_fixed_from,
        ),
        AngleConvention(
            "rotvec",
            "rotation vector: R = exp([a b c]x)",
            ("a", "b", "c"),
            ("Universal Robots",),
            True,
            exp_so3,
            log_so3,
        ),
        AngleConvention(
            "quaternion",
            "unit quaternion w, x, y, z",
            ("qw", "qx", "qy", "qz"),
            ("ABB",),
            False,
            rotation_from_quaternion,
            quaternion_from_rotation,
        ),
    )
}


def convention(key: str) -> AngleConvention:
    """The convention of this key.

    Raises:
        UnknownNameError: there is none; lists those there are.
    """
    if key not in CONVENTIONS:
        raise UnknownNameError(str(key), available=CONVENTIONS, what="angle convention")
    return CONVENTIONS[key]
