"""What joint logs look like, drawn as they come in practice."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app import catalog
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.cell import LAWS
from app.proof.generator.motion.making import MotionPlan

FRICTION = ("coulomb_friction", "viscous_friction")
#: Proven elsewhere: masses by the arms that are off everywhere (here every link is believed as it is described), joints
#: that twist by a stratum whose motions make them ring.
ELSEWHERE = ("link_inertia", "elastic_joint")


def draw_plan(rng: np.random.Generator) -> MotionPlan:
    """A log of some 20 to 40 seconds with the columns that logs have."""
    return MotionPlan(
        samples=int(rng.choice([2500, 3000, 4000])),
        rate=float(rng.choice([100.0, 125.0, 125.0])),
        noise=float(rng.uniform(0.002, 0.006)),
        stated=bool(rng.random() < 0.8),
        speeds=bool(rng.random() < 0.75),
        currents=bool(rng.random() < 0.3),
        temperatures=bool(rng.random() < 0.2),
        repeats=bool(rng.random() < 0.4),
        jitter=float(rng.choice([0.0, 0.0, 0.2])),
        strength=float(rng.uniform(2.0, 6.0)),
    )


def draw_effect(rng: np.random.Generator, *, but: Sequence[str] = (), package: str = LAWS) -> Request:
    """One law of a package."""
    keys = [k for k in catalog.members(package, "EFFECT") if k not in (*but, *ELSEWHERE)]
    return Request(keys[int(rng.integers(len(keys)))])
