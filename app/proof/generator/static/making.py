"""Draws a cell, puts the effects in, and measures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.errors import InputError
from app.proof.generator.arm import Arm
from app.proof.generator.effects.term import Request, Term, draw_term
from app.proof.generator.noise import draw_noise, draw_outliers
from app.proof.generator.rotations import random_rotation, turn_vector
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
from app.proof.generator.static.poses import free_poses, newton_step, touching_poses

ROW_SECONDS = 8.0
TYPICAL_COMPLIANCE = 4.0e-3  # rad at the joint's rated torque, a common harmonic drive
ORIENTATION_SIGMA = 2.0e-4  # rad
MOUNT = np.array([0.3, -0.2, 0.5])  # rad: how the measured body is turned in the flange
TORQUE_SIGMA = 0.01  # of the rated torque
TOUCHES = 1e-6  # m: a tip that is farther from its target does not touch it


@dataclass(frozen=True)
class Plan:
    """How a recording is made; lengths in metres.

    Args:
        kind: touch or tracker.
        samples: rows.
        noise: one-sigma of each axis.
        noise_kind: see noise.py.
        outliers: share of rows that went wrong.
        stated: False leaves the noise out of the header.
        sessions: number of set-ups, each with its own instrument frame and tool.
        reflectors: points on the tool, 1 to 3 (tracker).
        orientation: the tracker gives orientation too.
        wire: only the length of a draw-wire is measured.
        targets: touched points (touch).
        known_targets: their coordinates are in the file.
        repeats: rows that repeat a pose at once.
        loads_kg: declared loads, taken in turns over the rows.
        torque_sensors: joint torques are recorded.
        declares_compliance: the file states every joint's compliance.
        effect_rms: what an effect does to the tool point where its strength is left open.
    """

    kind: str = "tracker"
    samples: int = 60
    noise: float = 0.15e-3
    noise_kind: str = "gaussian"
    outliers: float = 0.0
    stated: bool = True
    sessions: int = 1
    reflectors: int = 1
    orientation: bool = False
    wire: bool = False
    targets: int = 5
    known_targets: bool = False
    repeats: int = 0
    loads_kg: tuple[float, ...] = ()
    torque_sensors: bool = False
    declares_compliance: bool = False
    effect_rms: float = 0.8e-3


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
    cell, pose = _draw_cell(plan, arm, described, rng)
    terms: list[Term] = list(held)
    for request in requests:
        term, open_strength = draw_term(request, law_of(request.effect), rng, cell)
        terms.append(scaled_to(cell, terms, term, plan.effect_rms) if open_strength else term)
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
    raw = [
        float(np.sqrt(np.mean(np.sum(effect_on_points(cell, terms, t)[:, 0] ** 2, axis=1)))) for t in terms
    ]
    return Made(
        plan=plan,
        cell=cell,
        terms=tuple(terms),
        raw_rms=tuple(raw),
        points=points,
        lengths=_lengths(plan, cell, world, noise) if plan.wire else None,
        orientations=_orientations(cell, world, rng) if plan.orientation else None,
        torques=_torques(standing(cell, terms), world, rng) if plan.torque_sensors else None,
        outliers=chosen,
        pose=pose,
    )


def _draw_cell(plan: Plan, arm: Arm, described: Arm, rng: np.random.Generator) -> tuple[Cell, np.ndarray]:
    m = plan.samples
    # rows of one session stand together; a repeated pose follows its first at once
    session = np.sort(np.arange(m) % max(plan.sessions, 1))
    again = np.zeros(m, bool)
    if plan.repeats:
        again[1 + rng.choice(m - 1, min(plan.repeats, m - 1), replace=False)] = True
    tip = rng.normal(0, 0.03, 3) + np.array([0.0, 0.0, rng.uniform(0.06, 0.25)])
    tools = np.repeat(tip[None, None], max(plan.sessions, 1), axis=0)
    tools = tools + rng.normal(0, 0.01, tools.shape) * (np.arange(len(tools)) > 0)[:, None, None]
    if plan.reflectors > 1:
        others = rng.normal(0, 0.08, (len(tools), plan.reflectors - 1, 3))
        tools = np.concatenate([tools, tools + others], axis=1)
    targets, fixture, target = np.zeros((1, 3)), np.eye(4), np.zeros(m, int)
    if plan.kind == "touch":
        count = max(1, min(plan.targets, m // 4))
        target = np.sort(np.arange(m) % count)
        q, places = touching_poses(arm, tip, np.bincount(target).tolist(), rng)
        fixture = _placed(rng, places.mean(axis=0))
        targets = np.round((places - fixture[:3, 3]) @ fixture[:3, :3], 7)
        again[:] = False
    else:
        q = free_poses(arm, m, rng)
        for i in np.flatnonzero(again):
            q[i] = q[i - 1]
            session[i] = session[i - 1]
    views = []
    for _ in range(len(tools)):
        view = _placed(rng, np.array([0.0, 0.0, 0.3]) + rng.normal(0, 0.3, 3))
        view[:3, 3] += rng.uniform(1.5, 3.5) * np.array([1.0, 0.0, 0.0])
        views.append(view)
    loads = (
        np.array([plan.loads_kg[i % len(plan.loads_kg)] for i in range(m)]) if plan.loads_kg else np.zeros(m)
    )
    loads = np.where(again, np.roll(loads, 1), loads)
    t = np.cumsum(rng.uniform(0.6, 1.4, m) * ROW_SECONDS)
    cell = Cell(
        kind=plan.kind,
        arm=arm,
        described=described,
        q=q,
        t=np.round(t - t[0], 3),
        tools=tools,
        views=np.array(views),
        mounts=np.repeat(turn_vector(MOUNT)[None], len(tools), axis=0),
        session=session,
        load_kg=loads,
        load_at=np.round(rng.normal(0, 0.02, 3) + np.array([0.0, 0.0, 0.06]), 4),
        target=target,
        targets=targets,
        fixture=fixture,
        targets_known=plan.known_targets,
        compliance=_typical_compliance(arm) if plan.declares_compliance else None,
        torque_sensors=plan.torque_sensors,
    )
    return cell, np.cumsum(~again)


def _typical_compliance(arm: Arm) -> np.ndarray:
    """(n,) [rad/Nm]: each joint bends by the same angle at its rated torque."""
    rated = np.where(arm.effort > 0, arm.effort, 100.0)
    return np.array([float(f"{c:.6g}") for c in TYPICAL_COMPLIANCE / rated])


def _placed(rng: np.random.Generator, place: np.ndarray) -> np.ndarray:
    frame = np.eye(4)
    frame[:3, :3] = random_rotation(rng)
    frame[:3, 3] = place
    return frame


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
