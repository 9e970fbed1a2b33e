"""What recordings of real arms look like, and what stands out in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app import catalog
from app.proof.generator.effects.term import Request
from app.proof.generator.noise import KINDS
from app.proof.generator.static.cell import OUTSIDE
from app.proof.generator.static.members import draw_build
from app.proof.generator.static.plan import Plan
from app.proof.generator.static.whole import Whole

#: Half of the arms have one thing that explains most.
DOMINANT = 0.5
SHARE = (0.6, 0.95)
#: What can stand out, and in which recordings.
EVERYWHERE = (
    "joint_zero", "link_length", "link_twist", "joint_compliance", "gear_eccentricity", "gear_ratio", "backlash",
    "joint_coupling", "joint_slip", "tool_slip", "base_shift", "joint_drift", "base_drift",
)  # fmt: skip
ONLY_TRACKER = ("instrument_zero_shift",)
REPEATS = ("at_once", "apart", "either_side")


def draw_run(rng: np.random.Generator, kind: str) -> Plan:
    """A recording for calibration: more rows than the least, noise not always stated, some rows wrong.

    Args:
        kind: touch, tracker or wire.
    """
    rows = {"touch": (80, 120, 200), "tracker": (60, 100, 150, 300), "wire": (150, 300)}[kind]
    common = {
        "samples": int(rng.choice(rows)),
        "noise": float(np.exp(rng.uniform(np.log(0.02e-3), np.log(0.15e-3)))),
        "noise_kind": str(rng.choice(KINDS, p=[0.3, 0.1, 0.3, 0.15, 0.15])),
        "outliers": float(rng.choice([0.0, 0.0, rng.uniform(0.01, 0.05)])),
        "stated": bool(rng.random() < 0.35),
        "effect_rms": float(rng.uniform(0.8e-3, 2.5e-3)),
        "lean": float(rng.choice([0.0, 0.0, 0.01])),
        "settling": int(rng.choice([0, 0, 0, 2])),
        "unseen": float(rng.choice([0.0, 0.0, 0.0, 0.1])),
    }
    if kind == "touch":
        return Plan(
            kind="touch",
            targets=int(rng.integers(4, 9)),
            known_targets=bool(rng.random() < 0.35),
            in_turns=bool(rng.random() < 0.4),
            **common,
        )
    wire = kind == "wire"
    return Plan(
        kind="tracker",
        wire=wire,
        sessions=int(rng.choice([1, 1, 1, 2])),
        reflectors=1 if wire else int(rng.choice([1, 1, 1, 2, 3])),
        orientation=bool(rng.random() < 0.2) and not wire,
        repeats=int(rng.choice([0, 8, 12])),
        repeats_as=str(rng.choice(REPEATS)),
        scatter=float(rng.choice([0.0, 0.0, 2e-5])),
        labelled=bool(rng.random() < 0.7),
        **common,
    )


def second_run(plan: Plan, rng: np.random.Generator) -> Plan:
    """The run to be predicted: new poses and set-up, no row wrong, so that an error is the model's."""
    rows = max(60, min(plan.samples, 120))
    return replace(
        plan,
        samples=rows,
        sessions=1,
        noise_kind="gaussian",
        outliers=0.0,
        repeats=0,
        unseen=0.0,
        settling=0,
        shuffled=False,
        known_targets=plan.known_targets,
        stated=bool(rng.random() < 0.5),
    )


def draw_dominant(rng: np.random.Generator, plan: Plan) -> Request:
    """One thing that explains most."""
    keys = [*EVERYWHERE, *(ONLY_TRACKER if plan.kind == "tracker" else ())]
    key = keys[int(rng.integers(len(keys)))]
    if key == "gear_eccentricity":
        return Request(key, {"order": int(rng.choice([1, 2]))})
    if key == "instrument_zero_shift":
        row = int(rng.integers(plan.samples // 4, 3 * plan.samples // 4))
        return Request(key, {"from_row": row} if rng.random() < 0.6 else {})
    if key == "backlash":
        return Request(key, {"driver": "approach"})
    return Request(key)


def draw_unknown(rng: np.random.Generator, plan: Plan) -> Request:
    """A law that no library holds."""
    keys = [k for k in catalog.members(OUTSIDE, "EFFECT") if plan.kind == "tracker" or k != "bent_light"]
    return Request(keys[int(rng.integers(len(keys)))])


def draw_arm(rng: np.random.Generator, plan: Plan, dominant: Request | None) -> Whole:
    """An arm and its two recordings."""
    return Whole(
        plan=plan,
        second=second_run(plan, rng),
        build=draw_build(rng),
        dominant=dominant,
        share=float(rng.uniform(*SHARE)) if dominant else 0.0,
        masses=float(rng.choice([0.0, 0.1, 0.2])),
    )
