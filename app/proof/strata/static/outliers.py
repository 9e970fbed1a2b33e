"""Some rows went wrong, with and without an effect."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.draft import Draft
from app.proof.strata.static._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Outliers:
    key: str = "outliers"
    title: str = "rows that went wrong"
    share: float = 0.06
    names_nothing: bool = False

    def draft(self, rng):
        plan = replace(draw_plan(rng), outliers=rng.uniform(0.03, 0.06))
        if rng.random() < 0.5:
            return Draft(plan)
        plan, request = draw_effect(rng, plan)
        return Draft(plan, [request])


STRATUM = Outliers()
