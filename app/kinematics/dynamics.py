"""Joint torques of a rigid arm for whole recordings: inverse dynamics, and what is linear in them.

Torque is linear in the links' inertial parameters (regressor.py), in gravity, and in a force at the flange. Each
of these is given as columns, so that a fit needs no finite differences.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)

from app.geometry.rotation import skew
from app.kinematics.regressor import PER_LINK
from app.kinematics.robot import GRAVITY, RobotModel

#: Order of the six: xx, xy, yy, xz, yz, zz.
_INERTIA_INDEX = ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))


def inertial_parameters(robot: RobotModel) -> np.ndarray:
    """(10 n,) of the description: per link m [kg], m c [kg m], I xx xy yy xz yz zz about its joint [kg m^2]."""
    return np.concatenate([inertia.toDynamicParameters() for inertia in list(robot.model.inertias)[1:]])


def inverse_dynamics(
    robot: RobotModel, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, *, gravity: np.ndarray = GRAVITY
) -> np.ndarray:
    """Torques of the description, one call of pin a sample.

    Args:
        q, qd, qdd: (m, n) [rad, rad/s, rad/s^2; metres for sliding joints].
        gravity: (3,) [m/s^2] in base.

    Returns:
        (m, n) [Nm or N].
    """
    model = _under(robot, gravity)
    data = model.createData()
    out = np.empty(q.shape)
    for i, (a, b, c) in enumerate(zip(q, qd, qdd, strict=True)):
        out[i] = pin.rnea(model, data, a, b, c)
    return out


def _under(robot: RobotModel, gravity: np.ndarray) -> pin.Model:
    """The arm's model with gravity (3,) [m/s^2] in base."""
    if np.array_equal(gravity, GRAVITY):
        return robot.model
    model = pin.Model(robot.model)
    model.gravity.linear = np.asarray(gravity, float)
    return model


def flange_to_last_link(robot: RobotModel) -> np.ndarray:
    """(10, 10): inertial parameters of a body in the flange frame -> the same body's in the last joint's frame."""
    placement = robot.model.frames[robot.flange_id].placement
    R, p = placement.rotation, placement.translation
    out = np.zeros((PER_LINK, PER_LINK))
    out[0, 0] = 1.0
    out[1:4, 0], out[1:4, 1:4] = p, R
    for k in range(PER_LINK):
        mass, first, second = _unit(k)
        # About the new origin: R I R^T - [p][m c'] terms of the parallel axes, c' = R c.
        moved = R @ first
        about = R @ second @ R.T - skew(p) @ skew(moved) - skew(moved) @ skew(p) - mass * skew(p) @ skew(p)
        out[4:, k] = [about[i] for i in _INERTIA_INDEX]
    return out


def _unit(k: int) -> tuple[float, np.ndarray, np.ndarray]:
    """The k-th unit body: mass, first moment, inertia."""
    first, second = np.zeros(3), np.zeros((3, 3))
    if 1 <= k <= 3:
        first[k - 1] = 1.0
    if k >= 4:
        i, j = _INERTIA_INDEX[k - 4]
        second[i, j] = second[j, i] = 1.0
    return (1.0 if k == 0 else 0.0), first, second


def point_mass(mass: float, com: np.ndarray) -> np.ndarray:
    """(10,) inertial parameters of a point mass [kg] at `com` (3,) [m]."""
    com = np.asarray(com, float)
    about = -mass * skew(com) @ skew(com)
    return np.concatenate([[mass], mass * com, [about[i] for i in _INERTIA_INDEX]])


def gravity_and_wrench_columns(robot: RobotModel, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What gravity and a wrench at the flange do to the joints, for many poses at once.

    Args:
        q: (m, n).

    Returns:
        d torque / d gravity (m, n, 3) [Nm per m/s^2], the description's masses, and
        d torque / d wrench (m, n, 6) [Nm per N, Nm per Nm]: torque a joint gives while the flange pushes on the world
        with a force, and turns it with a moment about the flange's origin, both in base axes.
    """
    chain = robot.chain
    frames = chain.frames(q)
    m, n = np.atleast_2d(q).shape
    # Links outward of joint j: their mass and first moment, in base.
    mass, moment = 0.0, np.zeros((m, 3))
    gravity = np.empty((m, n, 3))
    for j in range(n - 1, -1, -1):
        rotation, position = _link_frame(chain, frames, q, j)
        mass += chain.masses[j]
        moment = moment + chain.masses[j] * (position + rotation @ chain.coms[j])
        axis, origin = frames.axes[:, j], frames.joint_positions[:, j]
        lever = axis * mass if chain.prismatic[j] else np.cross(axis, moment - mass * origin)
        gravity[:, j] = -lever
    force = np.swapaxes(chain.jacobian_columns(frames, frames.flange_positions), 1, 2)
    turning = np.where(np.asarray(chain.prismatic)[:, None], 0.0, frames.axes)
    return gravity, np.concatenate([force, turning], axis=2)


def _link_frame(chain, frames, q: np.ndarray, j: int) -> tuple[np.ndarray, np.ndarray]:
    """Frame of link j after joint j moved: (m, 3, 3), (m, 3)."""
    rotation, position = frames.joint_rotations[:, j], frames.joint_positions[:, j]
    if chain.prismatic[j]:
        return rotation, position + frames.axes[:, j] * q[:, j, None]
    k = skew(chain.axes[j])
    s, c = np.sin(q[:, j])[:, None, None], np.cos(q[:, j])[:, None, None]
    return rotation @ (np.eye(3) + s * k + (1.0 - c) * (k @ k)), position
