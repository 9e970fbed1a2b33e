"""Draws what stands in a cell: tools, instruments, loads, and the poses in the order they are visited."""

from __future__ import annotations

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.dynamics import GRAVITY, turned_gravity
from app.proof.generator.rotations import random_rotation, turn_vector
from app.proof.generator.static.cell import Cell
from app.proof.generator.static.plan import Plan
from app.proof.generator.static.poses import free_poses, touching_poses
from app.proof.generator.static.visits import visited

ROW_SECONDS = 8.0
TYPICAL_COMPLIANCE = 4.0e-3  # rad at the joint's rated torque, a common harmonic drive
MOUNT = np.array([0.3, -0.2, 0.5])  # rad: how the measured body is turned in the flange


def draw_cell(plan: Plan, arm: Arm, described: Arm, rng: np.random.Generator) -> tuple[Cell, np.ndarray]:
    """A cell without effects, and the number of the pose each row holds (m,)."""
    m = plan.samples
    # rows of one session stand together; a repeated pose follows its first at once
    session = np.sort(np.arange(m) % max(plan.sessions, 1))
    again = np.zeros(m, bool)
    if plan.repeats and plan.repeats_as == "at_once":
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
        target = np.arange(m) % count
        target = target if plan.in_turns else np.sort(target)
        q, places = touching_poses(arm, tip, np.bincount(target).tolist(), rng)
        q = q[np.argsort(np.argsort(target, kind="stable"))]  # they come target by target
        fixture = _placed(rng, places.mean(axis=0))
        targets = np.round((places - fixture[:3, 3]) @ fixture[:3, :3], 7)
        again[:] = False
    else:
        q = free_poses(arm, m, rng)
        for i in np.flatnonzero(again):
            q[i] = q[i - 1]
            session[i] = session[i - 1]
    pose = np.cumsum(~again)
    if plan.repeats and plan.kind == "tracker" and plan.repeats_as != "at_once":
        q, pose = visited(q, plan.repeats, session, rng, either_side=plan.repeats_as == "either_side")
    if plan.scatter:
        q = q + plan.scatter * rng.normal(size=q.shape)
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
        gravity=turned_gravity(plan.lean * np.array([*rng.normal(size=2), 0.0])) if plan.lean else GRAVITY,
        settling=plan.settling,
        approached=_from_elsewhere(rng, q.shape, plan.unseen) if plan.unseen else None,
    )
    return cell, pose


def _from_elsewhere(rng: np.random.Generator, shape: tuple[int, ...], share: float) -> np.ndarray:
    """Signs of the last move into rows that were reached by way of a point not told; 0 in the other rows."""
    rows = rng.random(shape[0]) < share
    return rng.choice([-1.0, 1.0], shape) * rows[:, None]


def _typical_compliance(arm: Arm) -> np.ndarray:
    """(n,) [rad/Nm]: each joint bends by the same angle at its rated torque."""
    rated = np.where(arm.effort > 0, arm.effort, 100.0)
    return np.array([float(f"{c:.6g}") for c in TYPICAL_COMPLIANCE / rated])


def _placed(rng: np.random.Generator, place: np.ndarray) -> np.ndarray:
    frame = np.eye(4)
    frame[:3, :3] = random_rotation(rng)
    frame[:3, 3] = place
    return frame
