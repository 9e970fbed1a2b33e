"""The rigid-body torque's columns for whole recordings, all samples of a link at once.

Torque is linear in the links' inertial parameters. Spatial velocity and acceleration are carried outward link by
link, and with them every joint's screw, all six components of all of them by one product; what a unit of each
parameter costs a joint is then the power of its wrench on that screw.

Source: Atkeson, An, Hollerbach (1986), regressor form of the rigid-body dynamics; Featherstone (2008), ch. 2 and 5,
spatial vectors (angular part first) and the recursion outward.
"""

from __future__ import annotations

import numpy as np

from app.geometry.rotation import skew
from app.kinematics.robot import GRAVITY, RobotModel

#: Inertial parameters of one body: mass, mass times centre (3), inertia about the body frame's origin (6).
PER_LINK = 10
CHUNK = 2048  # samples whose intermediate results stay near the processor


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
    out = np.empty((n, PER_LINK * n, m))
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
    # In the link's frame, at its origin: its velocity, its acceleration less gravity, the screws of the joints so far.
    carried = np.zeros((6, 2, m))
    carried[3:, 1] = -gravity[:, None]
    for i in range(n):
        slides, (upright, c, way) = bool(chain.prismatic[i]), _frame(chain.axes[i])
        a, b = (c + 1) % 3, (c + 2) % 3
        rotation = chain.rotations[i] if upright is None else chain.rotations[i] @ upright
        here = np.empty((6, 3 + i, m))
        _move(rotation, chain.translations[i], carried, here[:, : 2 + i])
        here[:, 2 + i] = 0.0
        here[c + 3 * slides, 2 + i] = way
        velocity, acceleration, before = here[:, 0], here[:, 1], here[:, : 2 + i]
        speed, push = (qd[i], qdd[i]) if way > 0 else (-qd[i], -qdd[i])
        if slides:
            before[3 + a] += before[b] * (way * q[i])
            before[3 + b] -= before[a] * (way * q[i])
            acceleration[3 + a] += velocity[b] * speed
            acceleration[3 + b] -= velocity[a] * speed
        else:
            _turn(before[a::3], before[b::3], np.cos(q[i]), way * np.sin(q[i]))
            acceleration[a::3] += velocity[b::3] * speed
            acceleration[b::3] -= velocity[a::3] * speed
        velocity[c + 3 * slides] += speed
        acceleration[c + 3 * slides] += push
        if upright is not None:
            leant, here = here, np.empty_like(here)
            _move(upright.T, np.zeros(3), leant, here)
        carried, screws = here, here[:, 2:]
        forces, moments = _wrenches(here[:, 0], here[:, 1])
        columns = out[: i + 1, PER_LINK * i : PER_LINK * (i + 1)]
        np.einsum("cjm,kcm->jkm", screws[3:], forces, out=columns[:, :4])
        columns[:, 1:4] += np.einsum("cjm,kcm->jkm", screws[:3], moments[:3])
        np.einsum("cjm,kcm->jkm", screws[:3], moments[3:], out=columns[:, 4:])
        out[i + 1 :, PER_LINK * i : PER_LINK * (i + 1)] = 0.0  # joints beyond feel nothing of it


def _move(rotation: np.ndarray, origin: np.ndarray, vectors: np.ndarray, out: np.ndarray) -> None:
    """Spatial vectors (6, k, m) in a frame that stands at `origin`, turned by `rotation`, in theirs."""
    transform = np.zeros((6, 6))
    transform[:3, :3] = transform[3:, 3:] = rotation.T
    transform[3:, :3] = -rotation.T @ skew(origin)
    np.matmul(transform, vectors.reshape(6, -1), out=out.reshape(6, -1))  # a view: samples lie close


def _turn(x: np.ndarray, y: np.ndarray, cosine: np.ndarray, sine: np.ndarray) -> None:
    """The two components across the axis in a frame that is turned about it, in place."""
    first = cosine * x + sine * y
    y *= cosine
    y -= sine * x
    x[...] = first


def _wrenches(velocity: np.ndarray, acceleration: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Force (4, 3, m) that a unit of mass and of each first moment takes, and moment (9, 3, m) at the origin that
    each first moment and each inertia takes; velocity, acceleration (6, m)."""
    (x, y, z), (u, v, w) = velocity[:3], velocity[3:]
    terms = np.empty((len(_TERMS), len(x)))
    terms[:3] = acceleration[3:]  # of the origin, as a point of the body has it
    terms[0] += y * w - z * v
    terms[1] += z * u - x * w
    terms[2] += x * v - y * u
    terms[3:6] = acceleration[:3]
    np.multiply(velocity[:3], velocity[:3], out=terms[6:9])
    np.multiply(x, velocity[1:3], out=terms[9:11])
    np.multiply(y, z, out=terms[11])
    both = (_WRENCHES @ terms).reshape(13, 3, -1)
    return both[:4], both[4:]


def _frame(axis: np.ndarray) -> tuple[np.ndarray | None, int, float]:
    """In which frame a joint's axis is one of the three, which one, and which way; None for the link's own."""
    k = int(np.argmax(np.abs(axis)))
    if abs(axis[k]) == 1.0:
        return None, k, float(axis[k])
    other = np.eye(3)[int(np.argmin(np.abs(axis)))]
    first = skew(other) @ axis
    first = first / np.linalg.norm(first)
    return np.stack([first, skew(axis) @ first, axis], axis=1), 2, 1.0


#: What the wrenches are linear in: acceleration of the origin, of the turn, products of the turn's components.
_TERMS = ("px", "py", "pz", "ax", "ay", "az", "xx", "yy", "zz", "xy", "xz", "yz")
_FORCES = (
    ("px", "py", "pz"),
    # Acceleration of a point at c: (skew(spin) + skew(turn)^2) c, column by column.
    ("-yy-zz", "+xy+az", "+xz-ay"),
    ("+xy-az", "-xx-zz", "+yz+ax"),
    ("+xz+ay", "+yz-ax", "-xx-yy"),
)
_MOMENTS = (
    # c x acceleration of the origin.
    ("", "-pz", "+py"),
    ("+pz", "", "-px"),
    ("-py", "+px", ""),
    # Torque of the inertia: I spin + turn x (I turn), for unit xx, xy, yy, xz, yz, zz.
    ("+ax", "+xz", "-xy"),
    ("+ay-xz", "+ax+yz", "+xx-yy"),
    ("-yz", "+ay", "+xy"),
    ("+az+xy", "+zz-xx", "+ax-yz"),
    ("+yy-zz", "+az-xy", "+ay+xz"),
    ("+yz", "-xz", "+az"),
)


def _matrix(rows: tuple[tuple[str, str, str], ...]) -> np.ndarray:
    """(3 k, terms) of sums written out."""
    out = np.zeros((3 * len(rows), len(_TERMS)))
    for at, entry in enumerate(cell for row in rows for cell in row):
        for k, term in enumerate(_TERMS):
            if term in entry:
                out[at, k] = -1.0 if f"-{term}" in entry else 1.0
    return out


_WRENCHES = _matrix(_FORCES + _MOMENTS)
