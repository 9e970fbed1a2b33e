"""What static recordings look like, drawn as they come in practice."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from app import catalog
from app.proof.generator.effects.term import Request
from app.proof.generator.static.cell import LAWS
from app.proof.generator.static.making import Plan

TOUCH_SHARE = 0.4
TRACKER_NOISE = (0.05e-3, 0.1e-3, 0.15e-3)  # m
TOUCH_NOISE = 0.15e-3  # m

GEOMETRIC = ("joint_zero", "link_length", "link_twist")
#: Cannot be told from the tool in any touch, so they belong to the aliases.
HIDDEN = ("touch_indentation",)
ONLY_TRACKER = ("instrument_zero_shift", "instrument_scale")


def draw_plan(rng: np.random.Generator, kind: str | None = None) -> Plan:
    """A recording of about 60 rows with the extras that recordings sometimes have."""
    kind = kind or ("touch" if rng.random() < TOUCH_SHARE else "tracker")
    rms = rng.uniform(0.6e-3, 1.1e-3)
    stated = bool(rng.random() < 0.85)
    if kind == "touch":
        return Plan(
            kind="touch",
            samples=int(rng.choice([60, 60, 80, 120])),
            noise=TOUCH_NOISE,
            targets=int(rng.integers(4, 9)),
            known_targets=bool(rng.random() < 0.35),
            stated=stated,
            effect_rms=rms,
        )
    wire = bool(rng.random() < 0.05)
    return Plan(
        kind="tracker",
        samples=120 if wire else int(rng.choice([60, 60, 60, 90])),
        noise=float(rng.choice(TRACKER_NOISE)),
        stated=stated,
        sessions=2 if rng.random() < 0.1 else 1,
        reflectors=1 if wire else int(rng.choice([1, 1, 1, 1, 2, 3])),
        orientation=bool(rng.random() < 0.12) and not wire,
        wire=wire,
        repeats=8 if rng.random() < 0.3 else 0,
        loads_kg=(0.0, 5.0) if rng.random() < 0.25 else (),
        torque_sensors=bool(rng.random() < 0.1),
        effect_rms=rms,
    )


def draw_effect(
    rng: np.random.Generator, plan: Plan, *, but: Sequence[str] = (), package: str = LAWS
) -> tuple[Plan, Request]:
    """One law this kind of recording can carry, and the plan with what the law needs."""
    keys = [k for k in catalog.members(package, "EFFECT") if k not in (*but, *HIDDEN)]
    if plan.kind == "touch":
        keys = [k for k in keys if k not in (*ONLY_TRACKER, "bent_light")]
    key = keys[int(rng.integers(len(keys)))]
    if key == "payload":
        plan = replace(plan, declares_compliance=True, wire=False)
    return plan, Request(key)
