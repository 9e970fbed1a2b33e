"""Draws a cell, puts the effects in, and measures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.errors import InputError
from app.proof.generator.arm import Arm
from app.proof.generator.effects.term import Request, Term, draw_term
from app.proof.generator.noise import draw_noise, draw_outliers
from app.proof.generator.rotations import turn_vector
from app.proof.generator.static.cell import (
    Cell,
    World,
    contact,
    effect_on_points,
    goals,
    law_of,
    scaled_to,
    seen,
    shown,
    standing,
    turned,
    world_with,
)
from app.proof.generator.static.plan import Plan
from app.proof.generator.static.poses import newton_step
from app.proof.generator.static.setting import draw_cell

ORIENTATION_SIGMA = 2.0e-4  # rad
TORQUE_SIGMA = 0.01  # of the rated torque
TOUCHES = 1e-6  # m: a tip that is farther from its target does not touch it


@dataclass(frozen=True, eq=False)
class Made:
    """A recording and all that is true of it.

    Args:
        plan: how it was made.
        cell: with the joint positions as shown.
        terms: the effects in it.
        raw_rms: what each does to the tool point alone [m].
        points: (m, k, 3) measured points [m]; touches: the targets as told.
        lengths: (m,) draw-wire [m], or None.
        orientations: (m, 3, 3) measured, or None.
        torques: (m, n) measured, or None.
        outliers: rows (from 0) that went wrong.
        pose: (m,) number of the pose each row holds.
    """

    plan: Plan
    cell: Cell
    terms: tuple[Term, ...]
    raw_rms: tuple[float, ...]
    points: np.ndarray
    lengths: np.ndarray | None
    orientations: np.ndarray | None
    torques: np.ndarray | None
    outliers: np.ndarray
    pose: np.ndarray


def make(
    plan: Plan,
    arm: Arm,
    described: Arm,
    requests: Sequence[Request],
    rng: np.random.Generator,
    *,
    held: Sequence[Term] = (),
) -> Made:
    """One recording.

    Args:
        arm: as it stands there.
        described: as its description has it.
        held: effects that are settled already; they come first.

    Raises:
        InputError: an effect that this kind of recording cannot carry.
    """
    cell, pose = draw_cell(plan, arm, described, rng)
    terms: list[Term] = list(held)
    for request in requests:
        term, open_strength = draw_term(request, law_of(request.effect), rng, cell)
        terms.append(scaled_to(cell, terms, term, plan.effect_rms) if open_strength else term)
    return measure(plan, cell, pose, terms, rng)


def measure(
    plan: Plan,
    cell: Cell,
    pose: np.ndarray,
    terms: Sequence[Term],
    rng: np.random.Generator,
    *,
    raw: bool = True,
) -> Made:
    """The recording of a cell with these effects in it.

    Args:
        pose: (m,) number of the pose each row holds.
        raw: also tell what each effect does alone.

    Raises:
        InputError: a touch that cannot come about.
    """
    world = world_with(cell, terms)
    chosen, jumps = draw_outliers(rng, cell.m, plan.outliers, max(12.0 * plan.noise, 2.0e-3))
    components = 1 if plan.kind == "touch" else plan.reflectors
    noise = draw_noise(rng, (cell.m, components, 3), plan.noise, plan.noise_kind)
    noise[:, 0] += jumps
    if plan.kind == "touch":
        cell = _touched(cell, terms, noise[:, 0])
        points = cell.targets[cell.target][:, None]
        world = world_with(cell, terms)
    else:
        cell = cell.at(np.round(cell.q, 7))
        world = world_with(cell, terms)
        points = seen(cell, world) + noise
    alone = terms if raw else []
    raw_rms = [
        float(np.sqrt(np.mean(np.sum(effect_on_points(cell, terms, t)[:, 0] ** 2, axis=1)))) for t in alone
    ]
    return Made(
        plan=plan,
        cell=cell,
        terms=tuple(terms),
        raw_rms=tuple(raw_rms),
        points=points,
        lengths=_lengths(plan, cell, world, noise) if plan.wire else None,
        orientations=_orientations(cell, world, rng) if plan.orientation else None,
        torques=_torques(standing(cell, terms), world, rng) if plan.torque_sensors else None,
        outliers=chosen,
        pose=pose,
    )


def _touched(cell: Cell, terms: Sequence[Term], noise: np.ndarray) -> Cell:
    """Moves the arm until the tip touches, with everything that is wrong in place; angles as a file keeps them."""
    cell = shown(cell, cell.q, terms)
    gap = np.full((cell.m, 3), np.inf)
    for _ in range(8):
        world = world_with(cell, terms)
        tip, jacobian = contact(cell, world)
        gap = goals(cell, world) + noise - tip
        there = standing(cell, terms).q + newton_step(jacobian, gap, 1e-12)
        cell = shown(cell, there, terms)
    if not np.abs(gap).max() < TOUCHES:
        raise InputError("the tip cannot be brought to the target", expected="an arm that reaches it")
    return cell.at(np.round(cell.q, 8))


def _lengths(plan: Plan, cell: Cell, world: World, noise: np.ndarray) -> np.ndarray:
    return np.linalg.norm(seen(cell, world)[:, 0], axis=1) + noise[:, 0, 0]


def _orientations(cell: Cell, world: World, rng: np.random.Generator) -> np.ndarray:
    error = turn_vector(ORIENTATION_SIGMA * rng.normal(size=(cell.m, 3)))
    return turned(cell, world) @ error


def _torques(cell: Cell, world: World, rng: np.random.Generator) -> np.ndarray:
    rated = np.where(cell.arm.effort > 0, cell.arm.effort, 100.0)
    return cell.holding + world.torque + TORQUE_SIGMA * rated * 0.1 * rng.normal(size=cell.q.shape)
