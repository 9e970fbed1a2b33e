"""Joint positions that a sensible person would choose."""

from __future__ import annotations

import numpy as np

from app.errors import InputError
from app.proof.generator.arm import Arm, point_jacobian, stance

WIDEST = 2.7  # rad; cables and people do not like more
EDGE = 0.92  # of the way to a limit
FLOOR = -0.1  # m; the flange stays above
REACHED = 1e-8  # m
STARTS = 3  # at a time, for every touch that is wanted
THERE = 1e-9  # m: the last step squares what is left
TILT = np.cos(1.2)  # the tool leans at most this far from the way it first came


def comfortable(arm: Arm) -> tuple[np.ndarray, np.ndarray]:
    """(n,) lowest and highest position that is used."""
    middle, half = 0.5 * (arm.lower + arm.upper), 0.5 * EDGE * (arm.upper - arm.lower)
    widest = np.where(arm.slides, np.inf, WIDEST)
    return np.maximum(middle - half, -widest), np.minimum(middle + half, widest)


def free_poses(arm: Arm, count: int, rng: np.random.Generator) -> np.ndarray:
    """(count, n) drawn evenly over the joints, flange above the floor and away from the column."""
    low, high = comfortable(arm)
    kept = np.empty((0, arm.n))
    for attempt in range(60):
        q = rng.uniform(low, high, (4 * count, arm.n))
        place = stance(arm, q).flange_places
        away = np.hypot(place[:, 0], place[:, 1])
        good = (place[:, 2] > FLOOR) & (away > 0.3 * np.median(away)) | (attempt > 50)
        kept = np.vstack([kept, q[good]])
        if len(kept) >= count:
            break
    return kept[:count]


def touching_poses(
    arm: Arm, tip: np.ndarray, counts: list[int], rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Poses that put the tip on targets, the tool leaning this way and that.

    Args:
        tip: (3,) in the flange [m].
        counts: touches of each target.

    Returns:
        q (sum counts, n), target by target, and targets (p, 3) in base [m].

    Raises:
        InputError: the arm cannot reach a target in as many ways.
    """
    reference = free_poses(arm, 1, rng)[0]
    poses, targets = [], []
    for count in counts:
        for _ in range(40):
            q, target = _around(arm, tip, reference, count, rng)
            if len(q) == count:
                break
            reference = free_poses(arm, 1, rng)[0]
        else:
            raise InputError("this arm finds no poses that touch one point", expected="an arm that can tilt")
        poses.append(q)
        targets.append(target)
    return np.vstack(poses), np.array(targets)


def _around(arm, tip, reference, count, rng):
    low, high = comfortable(arm)
    q0 = np.clip(reference + rng.normal(0, 0.4, arm.n) * np.where(arm.slides, 0.1, 1.0), low, high)
    first = stance(arm, q0[None])
    target = first.flange_places[0] + first.flange_rotations[0] @ tip
    came = first.flange_rotations[0, :, 2]
    starts = np.clip(q0 + rng.normal(0, 1.2, (12 * count, arm.n)) * np.where(arm.slides, 0.1, 1.0), low, high)
    kept = np.empty((0, arm.n))
    for some in np.split(starts, range(STARTS * count, len(starts), STARTS * count)):
        q = towards(arm, some, tip, np.tile(target, (len(some), 1)))
        there = stance(arm, q)
        reached = there.flange_places + there.flange_rotations @ tip
        good = np.linalg.norm(reached - target, axis=1) < REACHED
        good &= np.all((q > low) & (q < high), axis=1) & (there.flange_rotations[:, :, 2] @ came > TILT)
        kept = np.vstack([kept, q[good]])
        if len(kept) >= count:
            break
    return kept[:count], target


def towards(arm: Arm, q: np.ndarray, tip: np.ndarray, target: np.ndarray, steps: int = 20) -> np.ndarray:
    """Damped Newton steps that bring the tip to `target` (m, 3); rows that do not get there just stop."""
    q, on_the_way = q.copy(), np.arange(len(q))
    for _ in range(steps):
        where = stance(arm, q[on_the_way])
        point = where.flange_places + where.flange_rotations @ tip
        gap = target[on_the_way] - point
        q[on_the_way] += newton_step(point_jacobian(arm, where, point), gap)
        on_the_way = on_the_way[np.linalg.norm(gap, axis=1) > THERE]
        if not len(on_the_way):
            break
    return q


def newton_step(jacobian: np.ndarray, gap: np.ndarray, damping: float = 1e-6) -> np.ndarray:
    """The least joint motion (m, n) that closes the gap (m, 3), at most 0.3 a step."""
    square = jacobian @ np.swapaxes(jacobian, 1, 2) + damping * np.eye(3)
    step = np.einsum(
        "mij,mj->mi", np.swapaxes(jacobian, 1, 2), np.linalg.solve(square, gap[..., None])[..., 0]
    )
    longest = np.abs(step).max(axis=1, keepdims=True)
    return step * np.minimum(1.0, 0.3 / np.maximum(longest, 1e-12))
