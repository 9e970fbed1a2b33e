"""A joint that twists: the motor follows its path, the link swings behind it on a spring with a damper.

The recorded angle is the motor's. The link's angle l obeys

    tau(q with l, l', l'') of this joint = stiffness (motor - l) + damping (motor' - l'),

tau the whole arm's rigid torque; it is integrated by Runge and Kutta's rule of fourth order, many steps a period, and
anew with the torques of the motion found until they stand still. Every joint has the torque of the arm as it swings.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.errors import InputError
from app.proof.generator.arm import stance
from app.proof.generator.dynamics import moved_inertia, moving_torques
from app.proof.generator.effects.motion._joint import JointTorque
from app.proof.generator.effects.term import Size

A_PERIOD = 60  # points of the grid in a period of the resonance
BEFORE = 1.0  # s of the path before the first sample, so that the start has been forgotten
PASSES = 3
FREQUENCY = (5.0, 14.0)  # Hz, as arms with harmonic drives have it
SAMPLES = 9.0  # that a log must have in a period
FARTHEST = 0.3  # rad of twist; no gear lives with more
RATIO = (0.03, 0.12)  # of the damping at which nothing rings


@dataclass(frozen=True)
class ElasticJoint(JointTorque):
    key: str = "elastic_joint"
    driver: str = "acceleration"
    sizes: tuple[Size, ...] = (Size("stiffness", "Nm/rad"), Size("damping", "Nm s/rad"))

    #: Only hard moves make it ring.
    brisk = True

    def draw(self, rng, cell, asked):
        term = super().draw(rng, cell, asked)
        return type(term)(term.effect, term.where, term.parameters, scalable=False)

    def values(self, rng, cell, j):
        rate = 1.0 / float(np.median(np.diff(cell.t)))
        slow, fast = FREQUENCY
        turn = 2.0 * np.pi * rng.uniform(slow, max(min(fast, rate / SAMPLES), slow))
        inertia = float(np.mean(own_inertia(cell.arm, cell.q[:: max(1, cell.m // 200)], j)))
        stiffness = inertia * turn**2
        return {
            "stiffness": float(stiffness),
            "damping": float(2.0 * rng.uniform(*RATIO) * np.sqrt(stiffness * inertia)),
        }

    def add(self, cell, term, world):
        stiffness, damping = (term.parameters[size.name] for size in self.sizes)
        if not stiffness > 0.0 or not damping >= 0.0:
            raise InputError(
                f"effect {self.key}: stiffness={stiffness:g}, damping={damping:g}",
                expected="a stiffness above 0 Nm/rad, a damping from 0 Nm s/rad",
            )
        joint = term.where["joint"]
        added, most = swinging(cell, joint - 1, stiffness, damping)
        if not most < FARTHEST:
            raise InputError(
                f"effect {self.key}: a stiffness of {stiffness:g} Nm/rad does not hold what is behind joint {joint}",
                expected=f"one under which it twists by less than {FARTHEST:g} rad",
            )
        world.torque += added


def own_inertia(arm, q: np.ndarray, j: int) -> np.ndarray:
    """(m,) inertia of all that joint j (from 0) moves, the others held [kg m^2]."""
    return moved_inertia(arm, stance(arm, q), j)


@lru_cache(maxsize=32)
def swinging(cell, j: int, stiffness: float, damping: float) -> tuple[np.ndarray, float]:
    """(m, n) torque on top of the rigid arm's while joint j (from 0) twists [Nm], and the farthest it does [rad]."""
    inertia = own_inertia(cell.arm, cell.q[:: max(1, cell.m // 200)], j)
    period = 2.0 * np.pi * np.sqrt(float(inertia.min()) / stiffness)
    count = int(np.ceil((cell.t[-1] - cell.t[0] + BEFORE) * A_PERIOD / period)) | 1  # odd: pairs of steps
    t = np.linspace(cell.t[0] - BEFORE, cell.t[-1], max(count, 5))
    arm, (q, qd, qdd) = cell.arm, cell.path(t)
    where = stance(arm, q)
    stiff = moving_torques(arm, q, qd, qdd, where=where)
    rigid = stiff[:, j]
    twist, rate, push = _integrated(t, rigid, moved_inertia(arm, where, j), stiffness, damping)
    for _ in range(PASSES - 1):
        if not np.abs(twist).max() < FARTHEST:
            return np.zeros((cell.m, arm.n)), np.inf
        there, speed = q.copy(), qd.copy()
        there[:, j] -= twist
        speed[:, j] -= rate
        where = stance(arm, there)
        rigid = moving_torques(arm, there, speed, qdd, where=where, since=j)[:, j]
        twist, rate, push = _integrated(t, rigid, moved_inertia(arm, where, j), stiffness, damping)
    for value, twisted in zip((q, qd, qdd), (twist, rate, push), strict=True):
        value[:, j] -= twisted
    swung = moving_torques(arm, q, qd, qdd) - stiff
    added = np.stack([np.interp(cell.t, t, column) for column in swung.T], axis=1)
    return added, float(np.abs(twist).max())


def _integrated(
    t, rigid, inertia, stiffness: float, damping: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Twist, its rate and acceleration (m,), from rest: inertia x'' + damping x' + stiffness x = rigid."""
    step = 2.0 * (t[1] - t[0])
    half, sixth = 0.5 * step, step / 6.0
    x, v = float(rigid[0]) / stiffness, 0.0
    load, mass = rigid.tolist(), inertia.tolist()
    xs, vs = [x], [v]
    for k in range(0, len(t) - 2, 2):  # written out: a function for the acceleration takes as long again
        a = (load[k] - damping * v - stiffness * x) / mass[k]
        v1 = v + half * a
        a1 = (load[k + 1] - damping * v1 - stiffness * (x + half * v)) / mass[k + 1]
        v2 = v + half * a1
        a2 = (load[k + 1] - damping * v2 - stiffness * (x + half * v1)) / mass[k + 1]
        v3 = v + step * a2
        a3 = (load[k + 2] - damping * v3 - stiffness * (x + step * v2)) / mass[k + 2]
        x += sixth * (v + 2.0 * v1 + 2.0 * v2 + v3)
        v += sixth * (a + 2.0 * a1 + 2.0 * a2 + a3)
        xs.append(x)
        vs.append(v)
    return _between(t, np.array(xs), np.array(vs), rigid, inertia, stiffness, damping)


def _between(t, xs, vs, rigid, inertia, stiffness, damping) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Values at every point, of which the integration gave every second: cubics with the known slopes between."""
    step = 2.0 * (t[1] - t[0])
    pushes = (rigid[::2] - damping * vs - stiffness * xs) / inertia[::2]
    twist, rate = np.empty_like(t), np.empty_like(t)
    for out, values, slopes in ((twist, xs, vs), (rate, vs, pushes)):
        out[::2] = values
        out[1::2] = 0.5 * (values[1:] + values[:-1]) + step / 8.0 * (slopes[:-1] - slopes[1:])
    return twist, rate, (rigid - damping * rate - stiffness * twist) / inertia


EFFECT = ElasticJoint()
