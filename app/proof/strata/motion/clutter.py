"""One effect in an arm whose every joint has dry and viscous friction."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.draft import Draft
from app.proof.strata.motion._plans import FRICTION, draw_effect, draw_plan


@dataclass(frozen=True)
class Clutter:
    key: str = "clutter"
    title: str = "one effect, friction in every joint"
    share: float = 0.14
    names_nothing: bool = False

    def draft(self, rng):
        plan = replace(draw_plan(rng), friction=float(rng.uniform(0.01, 0.04)))
        return Draft(plan, [draw_effect(rng, but=FRICTION)])


STRATUM = Clutter()
