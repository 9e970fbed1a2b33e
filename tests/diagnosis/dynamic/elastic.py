"""Logs of arms of which a joint twists, made by the generator: it integrates the link's motion, and shares no code."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.result import Diagnosis
from app.kinematics import load_robot
from app.proof.generator.arm import Arm
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.making import MadeMotion, MotionPlan, make_motion
from app.proof.generator.motion.writing import write_motion
from app.proof.generator.urdf import find_robot, read_arm
from app.proof.generator.urdf_writing import write_arm

PLAN = MotionPlan(samples=2500, rate=125.0, noise=0.002, brisk=True)


def pendulum() -> Arm:
    """One joint about a level axis, 8 kg behind it."""
    one = np.ones(1)
    return Arm(
        name="pendulum", rotations=np.stack([np.eye(3)] * 2), translations=np.array([[0, 0, 1.5], [0, 0, 0.4]]),
        axes=np.array([[0.0, 1.0, 0.0]]), slides=np.zeros(1, bool), lower=-2.0 * one, upper=2.0 * one,
        speed=3.0 * one, effort=60.0 * one, masses=8.0 * one, coms=np.array([[0.0, 0.02, 0.3]]),
        inertias=0.05 * np.eye(3)[None],
    )  # fmt: skip


def arm_of(name: str, folder: Path) -> tuple[Arm, str]:
    """A shipped arm, or the one above written to a folder; and how a header names it."""
    if name != "pendulum":
        return read_arm(find_robot(name)), name
    write_arm(pendulum(), folder / "pendulum.urdf")
    return pendulum(), "pendulum.urdf"


def made(name: str, folder: Path, seed: int, *requests: Request, plan: MotionPlan = PLAN) -> MadeMotion:
    """A log of one arm with these effects."""
    arm, _ = arm_of(name, folder)
    return make_motion(plan, arm, arm, requests, np.random.default_rng(seed))


def thinned(log: MadeMotion, every: int) -> MadeMotion:
    """The log as it is where only one sample in so many is kept."""
    kept = slice(None, None, every)
    cell = replace(log.cell, t=log.cell.t[kept])
    return replace(log, cell=cell, q=log.q[kept], qd=log.qd[kept], torque=log.torque[kept])


def told(name: str, folder: Path, log: MadeMotion) -> Diagnosis:
    """What is said of a log."""
    from app.recordings import read_table

    _, called = arm_of(name, folder)
    write_motion(log, folder / "log.csv", called)
    robot = load_robot(str(folder / called) if called.endswith(".urdf") else called)
    return diagnose(read_table(folder / "log.csv"), robot)


def elastic(found: Diagnosis) -> list:
    return [f for f in found.findings if f.effect == "elastic_joint"]
