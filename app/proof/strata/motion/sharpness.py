"""One law of friction in a joint whose sign fades over another speed, in another shape, than usual."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.draft import Draft
from app.proof.generator.effects.term import Request
from app.proof.strata.motion._plans import draw_plan

KEYS = ("coulomb_friction", "stribeck_friction", "load_friction", "warmup_friction", "viscous_friction")
WIDE = (5.0e-4, 5.0e-2)  # rad/s


@dataclass(frozen=True)
class Sharpness:
    key: str = "sharpness"
    title: str = "one friction, its sign as sharp as it happens to be"
    share: float = 0.06
    names_nothing: bool = False

    def draft(self, rng):
        plan = replace(draw_plan(rng), sharpness=WIDE, fading=str(rng.choice(["tanh", "arctan"])))
        return Draft(plan, [Request(KEYS[int(rng.integers(len(KEYS)))])])


STRATUM = Sharpness()
