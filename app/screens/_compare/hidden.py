"""A recording from a simulated cell in which something is wrong; what it is stays hidden until it is asked for."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from app.diagnosis.model import SavedModel
from app.kinematics import load_robot, robot_names
from app.kinematics.description.address import parse_address

#: Faults that a recording of sixty poses can show.
FAULTS = (
    "joint_zero",
    "joint_compliance",
    "link_length",
    "link_twist",
    "gear_eccentricity",
    "gear_ratio",
    "joint_coupling",
    "backlash",
    "joint_slip",
)
#: Faults that half a minute of joint torques can show.
MOTION_FAULTS = (
    "coulomb_friction",
    "viscous_friction",
    "contact",
    "payload_change",
    "torque_ripple",
    "rotor_inertia",
    "friction_asymmetry",
)
KINDS = ("tracker", "touch", "motion")
_NOISE = 1.5e-4  # m
_ROWS, _SAMPLES = 60, 3000


def make_hidden(robot: str, kind: str, folder: Path, seed: int) -> tuple[Path, tuple[dict, ...]]:
    """Writes a recording with one fault drawn by the seed.

    Args:
        robot: a shipped robot's name, or the address of another.
        kind: one of KINDS.
        folder: where it is written.

    Returns:
        The recording, and what is wrong in it: dictionaries with `effect` and `where`.
    """
    rng = np.random.default_rng(seed)
    fault = str(rng.choice(MOTION_FAULTS if kind == "motion" else FAULTS))
    out = folder / f"cell_{seed}.csv"
    truth = _log(robot, fault, seed, out) if kind == "motion" else _poses(robot, kind, fault, seed, out)
    said = json.loads(truth.read_text(encoding="utf-8"))
    truth.unlink()
    return out, tuple({"effect": e["effect"], "where": e["where"]} for e in said["effects"])


def make_with(robot: str, kind: str, model: SavedModel, folder: Path, seed: int) -> Path:
    """Writes a recording from a cell in which a saved model is true, and nothing else is wrong.

    Raises:
        InputError: a model of another arm or of another kind of recording.
    """
    from app.proof.generator.motion.making import MotionPlan
    from app.proof.generator.motion.simulate import simulate_motion
    from app.proof.generator.simulate import simulate_static
    from app.proof.generator.static.making import Plan
    from app.proof.held import terms_of

    out = folder / f"model_{seed}.csv"
    if kind == "motion":
        plan = MotionPlan(samples=_SAMPLES)
        held, _ = terms_of(model, kind, robot, samples=_SAMPLES, seconds=_SAMPLES / plan.rate)
        place, part = _place(robot)
        simulate_motion(place, plan, [], seed, out, held=held, part=part).unlink()
    else:
        held, _ = terms_of(model, kind, robot, samples=_ROWS)
        place, part = _place(robot)
        sizes = Plan(kind=kind, samples=_ROWS, noise=_NOISE)
        simulate_static(place, sizes, [], seed, out, held=held, part=part).unlink()
    return out


def _poses(robot: str, kind: str, fault: str, seed: int, out: Path) -> Path:
    from app.proof.generator.simulate import simulate_static
    from app.proof.generator.static.making import Plan

    place, part = _place(robot)
    return simulate_static(place, Plan(kind=kind, samples=_ROWS, noise=_NOISE), [fault], seed, out, part=part)


def _log(robot: str, fault: str, seed: int, out: Path) -> Path:
    from app.proof.generator.motion.making import MotionPlan
    from app.proof.generator.motion.simulate import simulate_motion

    place, part = _place(robot)
    return simulate_motion(place, MotionPlan(samples=_SAMPLES), [fault], seed, out, part=part)


def _place(robot: str) -> tuple[str, Any]:
    """The robot's name or file, and which part of that file is the arm; None of a shipped one, which is one arm."""
    from app.proof.generator.simulate import Part

    if robot in robot_names():
        return robot, None
    arm = load_robot(robot)
    return parse_address(robot).place, Part(arm.urdf, arm.flange, {"chain": f"{arm.base}..{arm.flange}"})
