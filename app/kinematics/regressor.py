"""The rigid-body torque's columns for whole recordings, all samples of a link at once.

Torque is linear in the links' inertial parameters. Speeds and accelerations are carried outward link by link, and
with them every joint's screw; what a unit of each parameter costs a joint is then the power of its wrench
on that screw.

Source: Atkeson, An, Hollerbach (1986), regressor form of the rigid-body dynamics; Featherstone (2008), ch. 5,
recursion outward.
"""

from __future__ import annotations

import numpy as np

from app.geometry.rotation import skew
from app.kinematics.robot import GRAVITY, RobotModel

#: Inertial parameters of one body: mass, mass times centre (3), inertia about the body frame's origin (6).
PER_LINK = 10
CHUNK = 4096  # samples whose intermediate results stay near the processor


def torque_regressor(
    robot: RobotModel, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, *, gravity: np.ndarray = GRAVITY
) -> np.ndarray:
    """Y with Y @ inertial_parameters = torque.

    Args:
        q, qd, qdd: (m, n).
        gravity: (3,) [m/s^2] in base.

    Returns:
        (m, n, 10 n); samples lie next to each other in memory.
    """
    m, n = q.shape
    out = np.zeros((n, PER_LINK * n, m))
    for start in range(0, m, CHUNK):
        part = slice(start, start + CHUNK)
        place, speed, push = (np.ascontiguousarray(x[part].T) for x in (q, qd, qdd))
        _fill(robot.chain, place, speed, push, np.asarray(gravity, float), out[:, :, part])
    return np.moveaxis(out, 2, 0)


def _fill(
    chain, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, gravity: np.ndarray, out: np.ndarray
) -> None:
    """q, qd, qdd (n, m); out (n, 10 n, m)."""
    n, m = q.shape
    turn, spin = np.zeros((2, 3, m))  # of the parent, in its own frame
    push = np.repeat(-gravity[:, None], m, axis=1)  # acceleration of its origin, less gravity
    about, along = np.zeros((2, 3, 0, m))  # screws of the joints before, at its origin
    for i in range(n):
        axis, slides = chain.axes[i], bool(chain.prismatic[i])
        arm = np.repeat(chain.translations[i][:, None], m, axis=1)
        if slides:
            arm += (chain.rotations[i] @ axis)[:, None] * q[i]
        push = push + _cross(spin, arm) + _cross(turn, _cross(turn, arm))
        along = along + _cross(about, arm[:, None])
        carried = np.concatenate([turn[:, None], spin[:, None], push[:, None], about, along], axis=1)
        carried = _into_link(chain.rotations[i], axis, None if slides else q[i], carried)
        turn, spin, push = carried[:, 0], carried[:, 1], carried[:, 2]
        about, along = carried[:, 3 : 3 + i], carried[:, 3 + i :]
        unit = axis[:, None]
        own = np.repeat(axis[:, None, None], m, axis=2)
        if slides:
            push = push + 2 * _cross(turn, unit * qd[i]) + unit * qdd[i]
            about, along = _joined(about, np.zeros_like(own)), _joined(along, own)
        else:
            spin = spin + _cross(turn, unit * qd[i]) + unit * qdd[i]
            turn = turn + unit * qd[i]
            about, along = _joined(about, own), _joined(along, np.zeros_like(own))
        _body(turn, spin, push, about, along, out[: i + 1, PER_LINK * i : PER_LINK * (i + 1)])


def _body(turn, spin, push, about, along, out: np.ndarray) -> None:
    """One link's ten columns on the joints before it; out (joints, 10, m)."""
    wx, wy, wz = turn
    xx, yy, zz, xy, xz, yz = wx * wx, wy * wy, wz * wz, wx * wy, wx * wz, wy * wz
    ax, ay, az = spin
    scratch = np.empty(along.shape[1:])
    _sum(out[:, 0], scratch, (along[0], push[0]), (along[1], push[1]), (along[2], push[2]))
    # Acceleration of a point at c: (skew(spin) + skew(turn)^2) c, column by column.
    field = (
        (-yy - zz, xy + az, xz - ay),
        (xy - az, -xx - zz, yz + ax),
        (xz + ay, yz - ax, -xx - yy),
    )
    for k, (x, y, z) in enumerate(field):
        b, c = (k + 1) % 3, (k + 2) % 3
        pushed = ((about[c], push[b]), (about[b], -push[c]))
        _sum(out[:, 1 + k], scratch, (along[0], x), (along[1], y), (along[2], z), *pushed)
    # Torque of the inertia: I spin + turn x (I turn), for unit xx, xy, yy, xz, yz, zz.
    inertia = (
        (ax, xz, -xy),
        (ay - xz, ax + yz, xx - yy),
        (-yz, ay, xy),
        (az + xy, zz - xx, ax - yz),
        (yy - zz, az - xy, ay + xz),
        (yz, -xz, az),
    )
    for k, (x, y, z) in enumerate(inertia):
        _sum(out[:, 4 + k], scratch, (about[0], x), (about[1], y), (about[2], z))


def _sum(out: np.ndarray, scratch: np.ndarray, *products: tuple[np.ndarray, np.ndarray]) -> None:
    """out = sum of the products, without new memory."""
    np.multiply(*products[0], out=out)
    for a, b in products[1:]:
        np.multiply(a, b, out=scratch)
        out += scratch


def _into_link(rotation: np.ndarray, axis: np.ndarray, angle: np.ndarray | None, vectors: np.ndarray):
    """Vectors (3, k, m) of the parent's frame in the link's, `angle` (m,) about `axis` further on."""
    flat = vectors.reshape(3, -1)
    if angle is None:
        return (rotation.T @ flat).reshape(vectors.shape)
    parallel = np.outer(axis, axis)
    parts = np.concatenate([parallel, np.eye(3) - parallel, -skew(axis)]) @ rotation.T
    still, cosine, sine = (parts @ flat).reshape(3, *vectors.shape)
    cosine *= np.cos(angle)
    sine *= np.sin(angle)
    still += cosine
    still += sine
    return still


def _joined(screws: np.ndarray, own: np.ndarray) -> np.ndarray:
    return np.concatenate([screws, own], axis=1)


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Along the first dimension; numpy's own is several times slower."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
