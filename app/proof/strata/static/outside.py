"""An effect that no library holds: a name given to it is false."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.generator.static.cell import OUTSIDE
from app.proof.strata.static._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Outside:
    key: str = "outside"
    title: str = "an effect that no library holds"
    share: float = 0.12
    names_nothing: bool = True

    def draft(self, rng):
        plan, request = draw_effect(rng, draw_plan(rng), package=OUTSIDE)
        return Draft(plan, [request])


STRATUM = Outside()
