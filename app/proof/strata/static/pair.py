"""Two different effects of the library."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.strata.static._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Pair:
    key: str = "pair"
    title: str = "two effects"
    share: float = 0.10
    names_nothing: bool = False

    def draft(self, rng):
        plan, first = draw_effect(rng, draw_plan(rng))
        plan, second = draw_effect(rng, plan, but=(first.effect,))
        return Draft(plan, [first, second])


STRATUM = Pair()
