"""One effect in an arm whose every length, twist and zero is a little off."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.strata.static._plans import GEOMETRIC, draw_effect, draw_plan


@dataclass(frozen=True)
class Clutter:
    key: str = "clutter"
    title: str = "one effect, all geometry off"
    share: float = 0.12
    names_nothing: bool = False

    def draft(self, rng):
        plan, request = draw_effect(rng, draw_plan(rng), but=(*GEOMETRIC, "instrument_scale"))
        return Draft(plan, [request], clutter=rng.uniform(0.1e-3, 0.4e-3))


STRATUM = Clutter()
