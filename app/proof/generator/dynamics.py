"""Torques: what holds the arm, and what moves it. In base coordinates, batched over rows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.proof.generator.arm import Arm, Stance, stance
from app.proof.generator.rotations import cross, times, turn_vector

#: Force through, and moment about, a body's centre of mass, and where that is: (m, 3) each.
Body = tuple[np.ndarray, np.ndarray, np.ndarray]
GRAVITY = np.array([0.0, 0.0, -9.81])  # m/s^2 in base


def holding_torques(
    arm: Arm,
    q: np.ndarray,
    *,
    gravity: np.ndarray = GRAVITY,
    load_kg: np.ndarray | float = 0.0,
    load_at: np.ndarray | None = None,
) -> np.ndarray:
    """Torque every joint gives to hold the arm: minus the work of gravity per unit of joint motion.

    Args:
        q: (m, n).
        load_kg: (m,) or one number, a point mass on the flange.
        load_at: (3,) [m] its place in the flange; default the flange's origin.

    Returns:
        (m, n) [Nm or N].
    """
    where = stance(arm, q)
    m, n = q.shape
    centres = where.places + np.einsum("mkij,kj->mki", where.rotations, arm.coms)
    at = np.zeros(3) if load_at is None else np.asarray(load_at, float)
    load_place = where.flange_places + where.flange_rotations @ at
    # What joint j carries: the mass and the first moment of everything outward of it.
    mass = np.cumsum(arm.masses[::-1])[::-1][None, :] + np.broadcast_to(load_kg, (m,))[:, None]
    moment = np.cumsum((arm.masses[None, :, None] * centres)[:, ::-1], axis=1)[:, ::-1]
    moment = moment + (np.broadcast_to(load_kg, (m,))[:, None] * load_place)[:, None, :]
    force = mass[..., None] * gravity
    twist = cross(moment - mass[..., None] * where.places, gravity)
    along = np.where(arm.slides[None, :, None], force, twist)
    assert n == arm.n
    return -np.einsum("mki,mki->mk", where.axes, along)


def moving_torques(
    arm: Arm,
    q: np.ndarray,
    qd: np.ndarray,
    qdd: np.ndarray,
    *,
    gravity: np.ndarray = GRAVITY,
    load_kg: np.ndarray | float = 0.0,
    load_at: np.ndarray | None = None,
    load_inertia: np.ndarray | None = None,
    load_link: int | None = None,
    where: Stance | None = None,
    since: int = 0,
) -> np.ndarray:
    """Recursive Newton-Euler: torques of a moving arm, (m, n) each argument -> (m, n).

    A load of `load_kg` sits at `load_at` (3,) [m] in the flange, or in the frame of link `load_link` (from 0).
    Who has the arm's stance at q already gives it as `where`. Joints before `since` (from 0) are not asked for: 0.

    Outward: speeds and accelerations of every link; inward: the forces that cause them. A body that falls
    freely needs no force, so gravity enters as an upward acceleration of the base.

    Source: Luh, Walker, Paul (1980).
    """
    where = stance(arm, q) if where is None else where
    m, n = q.shape
    load_at = np.zeros(3) if load_at is None else np.asarray(load_at, float)
    spin, spin_rate = np.zeros((m, 3)), np.zeros((m, 3))
    push = np.broadcast_to(-np.asarray(gravity, float), (m, 3))  # acceleration of the frame's origin
    origin = np.zeros((m, 3))
    bodies = []
    for k in range(n):
        axis, place = where.axes[:, k], where.places[:, k]
        # the point of the link before that coincides with this origin
        lever = place - origin
        push = push + cross(spin_rate, lever) + cross(spin, cross(spin, lever))
        if arm.slides[k]:
            push = push + 2.0 * cross(spin, axis * qd[:, k, None]) + axis * qdd[:, k, None]
        else:
            spin_rate = spin_rate + axis * qdd[:, k, None] + cross(spin, axis * qd[:, k, None])
            spin = spin + axis * qd[:, k, None]
        origin = place
        if k < since:
            continue
        rotation = where.rotations[:, k]
        body = _body(rotation, place, spin, spin_rate, push, arm.masses[k], arm.coms[k], arm.inertias[k])
        if k == (n - 1 if load_link is None else load_link) and np.any(np.asarray(load_kg) != 0):
            flange = (where.flange_rotations, where.flange_places)
            body = _with_load(
                body,
                flange if load_link is None else (rotation, place),
                (spin, spin_rate, push, place),
                np.broadcast_to(load_kg, (m,)),
                load_at,
                np.zeros((3, 3)) if load_inertia is None else load_inertia,
            )
        bodies.append(body)
    return _inward(arm, where, bodies, since)


def moved_inertia(arm: Arm, where: Stance, j: int) -> np.ndarray:
    """(m,) inertia of all that joint j (from 0) moves, the others held [kg m^2 or kg].

    To the last bit `moving_torques` of an acceleration of 1 from rest without gravity, without working out all that is
    nothing then: an elastic joint asks at thousands of stances.
    """
    axis = where.axes[:, j]
    still = np.zeros_like(axis)
    turning, push = (still, axis) if arm.slides[j] else (axis, still)
    bodies = []
    for k in range(j, arm.n):
        rotation, place = where.rotations[:, k], where.places[:, k]
        if k > j:
            push = push + cross(turning, place - where.places[:, k - 1])
        arm_to = rotation @ arm.coms[k]
        world = times(rotation, arm.inertias[k]) @ np.swapaxes(rotation, 1, 2)
        force = arm.masses[k] * (push + cross(turning, arm_to))
        bodies.append((force, np.einsum("mij,mj->mi", world, turning), place + arm_to))
    return _inward(arm, where, bodies, j)[:, j]


def _inward(arm: Arm, where: Stance, bodies: Sequence[Body], since: int) -> np.ndarray:
    """(m, n) torques of the joints from `since` on, that move the bodies from there on; those before: 0."""
    m, n = where.axes.shape[:2]
    torque = np.zeros((m, n))
    total_force, total_moment = np.zeros((m, 3)), np.zeros((m, 3))
    for k in reversed(range(since, n)):
        force, moment, centre = bodies[k - since]
        place = where.places[:, k]
        if k < n - 1:
            total_moment = total_moment + cross(where.places[:, k + 1] - place, total_force)
        total_force = total_force + force
        total_moment = total_moment + moment + cross(centre - place, force)
        along = total_force if arm.slides[k] else total_moment
        torque[:, k] = np.einsum("mi,mi->m", where.axes[:, k], along)
    return torque


def _body(rotation, place, spin, spin_rate, push, mass, com, inertia):
    """Force through, and moment about, a rigid body's centre of mass."""
    arm_to = rotation @ com
    acceleration = push + cross(spin_rate, arm_to) + cross(spin, cross(spin, arm_to))
    world = times(rotation, inertia) @ np.swapaxes(rotation, 1, 2)
    momentum = np.einsum("mij,mj->mi", world, spin)
    moment = np.einsum("mij,mj->mi", world, spin_rate) + cross(spin, momentum)
    return mass * acceleration, moment, place + arm_to


def _with_load(body, flange, motion, load_kg, load_at, load_inertia):
    """Adds the load's force at its own place, carried to the link's centre."""
    force, moment, centre = body
    rotation, flange_place = flange
    spin, spin_rate, push, place = motion
    at = flange_place + rotation @ load_at
    lever = at - place
    acceleration = push + cross(spin_rate, lever) + cross(spin, cross(spin, lever))
    extra = load_kg[:, None] * acceleration
    world = rotation @ load_inertia @ np.swapaxes(rotation, 1, 2)
    turning = np.einsum("mij,mj->mi", world, spin_rate) + cross(spin, np.einsum("mij,mj->mi", world, spin))
    share = (load_kg > 0)[:, None]
    return force + extra, moment + cross(at - centre, extra) + share * turning, centre


def turned_gravity(tilt: np.ndarray) -> np.ndarray:
    """Gravity in the base of an arm that stands tilted by a rotation vector (3,) [rad]."""
    return turn_vector(np.asarray(tilt, float)).T @ GRAVITY
