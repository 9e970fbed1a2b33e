"""One joint log with the effects that were asked for, and its truth beside it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from app.errors import InputError
from app.proof.generator.effects.term import Term, parse_request
from app.proof.generator.files import truth_path, write_truth
from app.proof.generator.motion.cell import LAWS
from app.proof.generator.motion.making import MotionPlan, make_motion
from app.proof.generator.motion.writing import motion_truth, write_motion
from app.proof.generator.simulate import Part, check_rows, read_part, robot_key, writable
from app.proof.generator.static.clutter import lumped, misweighed
from app.proof.generator.urdf import find_robot

FEWEST_SAMPLES = 100


def simulate_motion(
    robot: str,
    plan: MotionPlan,
    effects: Sequence[str],
    seed: int,
    out: Path,
    *,
    held: Sequence[Term] = (),
    wrong_masses: float = 0.0,
    part: Part | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> Path:
    """Writes `out` and its truth; returns the path of the truth.

    Args:
        held: effects with all their values, such as those of a saved model.
        part: the arm within the description, where it was chosen.

    Raises:
        InputError: no such robot, effect, option or folder.
    """
    requests = [parse_request(text, LAWS) for text in effects]
    check_rows(plan.samples)
    if plan.samples < FEWEST_SAMPLES:
        raise InputError(f"{plan.samples} samples", expected=f"a log of {FEWEST_SAMPLES} or more")
    path = find_robot(robot)
    described = read_part(path, part)
    rng = np.random.default_rng(seed)
    weightless = not np.any(described.masses)
    arm = lumped(described) if weightless else described
    arm = misweighed(arm, wrong_masses, rng) if wrong_masses else arm
    made = make_motion(plan, arm, described, requests, rng, held=held)
    out = writable(out)
    write_motion(made, out, robot_key(robot, path, out), {} if part is None else part.header)
    truth = truth_path(out)
    write_truth(truth, {**motion_truth(made), "seed": seed, "robot": robot})
    if weightless:
        say("the description states no masses: took 20 kg per metre of link")
    say(f"wrote {out} and {truth}")
    return truth
