"""A recording from a simulated cell in which something is wrong; what it is stays hidden until it is asked for."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

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
KINDS = ("tracker", "touch")
_NOISE = 1.5e-4  # m
_ROWS = 60


def make_hidden(robot: str, kind: str, folder: Path, seed: int) -> tuple[Path, tuple[dict, ...]]:
    """Writes a recording with one fault drawn by the seed.

    Args:
        robot: a shipped robot's name.
        kind: one of KINDS.
        folder: where it is written.

    Returns:
        The recording, and what is wrong in it: dictionaries with `effect` and `where`.
    """
    from app.proof.generator.simulate import simulate_static
    from app.proof.generator.static.making import Plan

    rng = np.random.default_rng(seed)
    fault = str(rng.choice(FAULTS))
    out = folder / f"cell_{seed}.csv"
    plan = Plan(kind=kind, samples=_ROWS, noise=_NOISE)
    truth = simulate_static(robot, plan, [fault], seed, out)
    said = json.loads(truth.read_text(encoding="utf-8"))
    truth.unlink()
    return out, tuple({"effect": e["effect"], "where": e["where"]} for e in said["effects"])
