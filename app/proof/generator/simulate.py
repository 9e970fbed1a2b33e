"""One recording with the effects that were asked for, and its truth in a file beside it."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from app import catalog, resources
from app.errors import InputError
from app.proof.generator.arm import Arm
from app.proof.generator.effects.term import Term, parse_request
from app.proof.generator.files import truth_of, truth_path, write_static, write_truth
from app.proof.generator.static.cell import LAWS
from app.proof.generator.static.clutter import as_built, lumped, misweighed
from app.proof.generator.static.making import Plan, make
from app.proof.generator.urdf import find_robot, read_arm

FEWEST, MOST = 4, 1_000_000


def simulate_static(
    robot: str,
    plan: Plan,
    effects: Sequence[str],
    seed: int,
    out: Path,
    *,
    held: Sequence[Term] = (),
    clutter: float = 0.0,
    wrong_masses: float = 0.0,
    part: Part | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> Path:
    """Writes `out` and its truth.

    Args:
        robot: a shipped name or the path of a URDF.
        effects: `NAME[:key=value,...]` each.
        held: effects with all their values, such as those of a saved model.
        clutter: one-sigma error of every length [m] of the arm as built.
        wrong_masses: share by which its masses differ from the description.
        part: the arm within the description, where it was chosen.
        say: called with what is being done.

    Returns:
        The path of the truth.

    Raises:
        InputError: no such robot, effect, option or folder.
    """
    requests = [parse_request(text, LAWS) for text in effects]
    check_rows(plan.samples)
    path = find_robot(robot)
    described = read_part(path, part)
    rng = np.random.default_rng(seed)
    arm = as_built(described, clutter, rng) if clutter else described
    arm = misweighed(arm, wrong_masses, rng) if wrong_masses else arm
    wanted = {r.effect for r in (*requests, *held)}
    if "payload" in wanted:
        plan = replace(plan, declares_compliance=True)
    if "instrument_scale" in wanted and plan.kind == "touch":
        plan = replace(plan, known_targets=True)
    weightless = not np.any(described.masses)
    made = make(plan, lumped(arm) if weightless else arm, described, requests, rng, held=held)
    out = writable(out)
    write_static(made, out, robot_key(robot, path, out), more={} if part is None else part.header)
    truth = truth_path(out)
    write_truth(truth, {**truth_of(made), "seed": seed, "robot": robot})
    if weightless:
        say("the description states no masses: took 20 kg per metre of link")
    say(f"wrote {out} and {truth}")
    return truth


@dataclass(frozen=True)
class Part:
    """The arm within a description.

    Args:
        urdf: a URDF in which only the arm's joints move.
        flange: the link that ends it.
        header: what the recording's header says of the choice, beside `robot`.
    """

    urdf: str
    flange: str
    header: dict[str, str]


def read_part(path: Path, part: Part | None) -> Arm:
    """The arm of a description, or the part of it that was chosen."""
    return read_arm(path) if part is None else read_arm(path, part.urdf, part.flange)


def check_rows(samples: int) -> None:
    """Raises InputError where no recording has so many rows."""
    if not FEWEST <= samples <= MOST:
        raise InputError(f"{samples} samples", expected=f"{FEWEST} to {MOST}")


def writable(out: Path) -> Path:
    """The path, if its folder is there."""
    if not out.parent.is_dir():
        raise InputError("there is no such folder", file=out.parent, expected="a folder to write into")
    if out.is_dir():
        raise InputError("is a folder", file=out, expected="the name of a CSV file")
    return out


def robot_key(robot: str, path: Path, out: Path) -> str:
    """What the header names: a shipped name, or the description's path from the recording's folder."""
    if robot in catalog.folders(resources.ROBOTS, "robot.toml"):
        return robot
    return Path(os.path.relpath(path.resolve(), out.resolve().parent)).as_posix()
