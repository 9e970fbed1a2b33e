"""Two turning axes -> base frame, with the covariance carried along; any number of cells at once.

Z = L1, X = the common perpendicular of L1 and L2, origin its foot on L1, Y = Z x X.

Uncertainty of a frame is a covariance of (6,) = (displacement [m], rotation vector [rad]), both in the axes of
the frame itself: T_true = T @ Pose.exp(that).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.geometry.line import common_perpendicular, cross, dot
from app.geometry.pose import Pose
from app.geometry.rotation import skew


@dataclass(frozen=True, eq=False)
class Axes:
    """A turning axis as a line with its uncertainty; any batch.

    Args:
        point: (..., 3) [m].
        basis: (..., 3, 3), rows e1, e2, direction.
        covariance: (..., 4, 4) of shift along e1, e2 [m] and tilt towards e1, e2 [rad] at `point`.
    """

    point: np.ndarray
    basis: np.ndarray
    covariance: np.ndarray

    @property
    def direction(self) -> np.ndarray:
        """(..., 3) unit, along the positive turn."""
        return self.basis[..., 2, :]

    def reversed_where(self, negative: np.ndarray) -> Axes:
        """The same lines, pointing the other way where `negative` (...,) is True."""
        sign = np.where(negative, -1.0, 1.0)
        # (e1, -e2, -n) is right-handed again; a tilt towards e1 is then measured against -n.
        flips = np.stack([np.ones_like(sign), sign, sign], axis=-1)
        change = np.stack([np.ones_like(sign), sign, sign, np.ones_like(sign)], axis=-1)
        covariance = self.covariance * change[..., :, None] * change[..., None, :]
        return Axes(self.point, self.basis * flips[..., None], covariance)


@dataclass(frozen=True, eq=False)
class BaseFrames:
    """Base frames of a batch of cells.

    Args:
        matrices: (..., 4, 4) T_tracker_base.
        covariance: (..., 6, 6), see the top of this file.
        offset: (...,) [m] length of the common perpendicular, positive where axis 2 lies towards +X.
        offset_sigma: (...,) [m].
        angle: (...,) [rad] from axis 1 to axis 2.
        angle_sigma: (...,) [rad].
        axis2_along_y: (...,) direction of axis 2 on Y; negative says that a direction is wrong.
        towards: (...,) [m] the work-space point on X; near 0 leaves the sign of X open.
    """

    matrices: np.ndarray
    covariance: np.ndarray
    offset: np.ndarray
    offset_sigma: np.ndarray
    angle: np.ndarray
    angle_sigma: np.ndarray
    axis2_along_y: np.ndarray
    towards: np.ndarray


def base_frames(first: Axes, second: Axes, towards: np.ndarray, *, unclear: np.ndarray | float) -> BaseFrames:
    """The patent's base frame of every cell.

    Args:
        first, second: axis 1 and axis 2, pointing along their positive turn.
        towards: (..., 3) [m] a point in front of the robot; X points to its side.
        unclear: (...,) [m] if that point is nearer than this to the plane through axis 1 across X, the turn
            of axis 2 decides instead (it turns about +Y).

    Returns:
        BaseFrames; NaN where the axes are parallel.

    Source: the patent's steps 4.1 to 4.3; the sign rules are this program's.
    """
    z, d2 = first.direction, second.direction
    perpendicular = common_perpendicular(first.point, z, second.point, d2)
    by_turn = cross(d2, z) / perpendicular.sine[..., None]  # Y x Z with d2 on the side of Y
    reach = dot(towards - perpendicular.foot_1, by_turn)
    sign = np.where(np.abs(reach) > unclear, np.where(reach < 0, -1.0, 1.0), 1.0)
    x = by_turn * sign[..., None]
    y = cross(z, x)
    rotation = np.stack([x, y, z], axis=-1)
    matrices = np.zeros((*rotation.shape[:-2], 4, 4))
    matrices[..., :3, :3], matrices[..., :3, 3], matrices[..., 3, 3] = rotation, perpendicular.foot_1, 1.0

    offset = dot(second.point - first.point, x)
    j1, j2 = _jacobians(rotation, first, second, perpendicular.along_1, perpendicular.along_2, offset)
    covariance = j1 @ first.covariance @ np.swapaxes(j1, -1, -2)
    covariance = covariance + j2 @ second.covariance @ np.swapaxes(j2, -1, -2)

    # The angle between the axes only sees tilts in the plane of Z and axis 2.
    grow_1, grow_2 = _angle_gradients(first, second, perpendicular.sine)
    angle_var = _quadratic(first.covariance, grow_1) + _quadratic(second.covariance, grow_2)
    gap_1, gap_2 = (
        _gap_gradient(a, x, t, s)
        for a, t, s in ((first, perpendicular.along_1, -1.0), (second, perpendicular.along_2, 1.0))
    )
    gap_var = _quadratic(first.covariance, gap_1) + _quadratic(second.covariance, gap_2)
    return BaseFrames(
        matrices,
        covariance,
        offset,
        np.sqrt(gap_var),
        np.arctan2(perpendicular.sine, perpendicular.cosine),
        np.sqrt(angle_var),
        dot(d2, y),
        reach * sign,
    )


def _quadratic(covariance: np.ndarray, gradient: np.ndarray) -> np.ndarray:
    return np.einsum("...i,...ij,...j->...", gradient, covariance, gradient)


def _gap_gradient(axis: Axes, x: np.ndarray, along: np.ndarray, sign: float) -> np.ndarray:
    """d offset / d (shift, tilt): the displacement of the foot along X."""
    e = np.einsum("...jk,...k->...j", axis.basis[..., :2, :], x)
    return sign * np.concatenate([e, along[..., None] * e], axis=-1)


def _angle_gradients(first: Axes, second: Axes, sine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    out = []
    for axis, other in ((first, second), (second, first)):
        e = np.einsum("...jk,...k->...j", axis.basis[..., :2, :], other.direction)
        out.append(np.concatenate([np.zeros_like(e), -e / sine[..., None]], axis=-1))
    return out[0], out[1]


def _jacobians(rotation, first, second, along_1, along_2, offset) -> tuple[np.ndarray, np.ndarray]:
    """d (displacement, rotation) in the frame's axes / d (shift, tilt) of each axis, (..., 6, 4) each.

    With everything in the frame's axes (Z = ez, X = ex) and axis 2 along n = (0, b, c): a change dz of Z turns
    the frame by phi_x = -dz_y and phi_y = dz_x; phi_z keeps X square to axis 2, d(X . n) = 0. The origin
    follows L1 sideways and slides along it until the perpendicular's other end stays on L2.
    """
    to_frame = np.swapaxes(rotation, -1, -2)
    n = np.einsum("...ij,...j->...i", to_frame, second.direction)
    b, c = n[..., 1], n[..., 2]
    batch = b.shape
    jacobians = []
    for axis, along, one in ((first, along_1, True), (second, along_2, False)):
        e = to_frame @ np.swapaxes(axis.basis[..., :2, :], -1, -2)  # (..., 3, 2): e1, e2 in the frame
        lateral = np.concatenate(
            [e, along[..., None, None] * e], axis=-1
        )  # displacement at the foot, (..., 3, 4)
        turn = np.concatenate([np.zeros_like(e), e], axis=-1)  # change of the direction, (..., 3, 4)
        phi = np.zeros((*batch, 3, 4))
        if one:
            phi[..., 0, :], phi[..., 1, :] = -turn[..., 1, :], turn[..., 0, :]
            # dX = phi x ex = (0, phi_z, -phi_y); 0 = dX . n = b phi_z - c phi_y
            phi[..., 2, :] = (c / b)[..., None] * phi[..., 1, :]
            slip = -lateral
            shift = lateral.copy()
        else:
            phi[..., 2, :] = -turn[..., 0, :] / b[..., None]  # 0 = dX . n + ex . dn
            slip = lateral
            shift = np.zeros_like(lateral)
        # The feet's difference, less what the turned perpendicular carries, must vanish across axis 2 in the
        # plane of Y and Z, that is along m = (0, -c, b): slide s of the origin with s (m . ez) = slip . m - d dX . m
        carried = offset[..., None] * (-c[..., None] * phi[..., 2, :] - b[..., None] * phi[..., 1, :])
        across = -c[..., None] * slip[..., 1, :] + b[..., None] * slip[..., 2, :]
        shift[..., 2, :] = shift[..., 2, :] + (across - carried) / b[..., None]
        jacobians.append(np.concatenate([shift, phi], axis=-2))
    return jacobians[0], jacobians[1]


def point_jacobian(p_frame: np.ndarray) -> np.ndarray:
    """d (place of a point held in the frame) / d (displacement, rotation), in the frame's axes; (..., 3, 6)."""
    p_frame = np.asarray(p_frame, float)
    eye = np.broadcast_to(np.eye(3), (*p_frame.shape[:-1], 3, 3))
    return np.concatenate([eye, -skew(p_frame)], axis=-1)


def adjoint(T_a_b: Pose) -> np.ndarray:
    """(6, 6): a small motion (displacement, rotation) of frame b in b's axes -> the same motion in a, at a's origin."""
    out = np.zeros((6, 6))
    out[:3, :3] = out[3:, 3:] = T_a_b.rotation
    out[:3, 3:] = cross(T_a_b.position[None, :], T_a_b.rotation.T).T
    return out


def in_parent(T_a_b: Pose, covariance: np.ndarray) -> np.ndarray:
    """(6, 6) of where b stands in a, along and about the axes of a: what belongs beside T_a_b's own numbers.

    Args:
        covariance: (6, 6) the same in b's axes, see the top of this file.
    """
    turn = np.kron(np.eye(2), T_a_b.rotation)
    return turn @ covariance @ turn.T
