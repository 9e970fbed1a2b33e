"""Two different effects of the library."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.strata.motion._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Pair:
    key: str = "pair"
    title: str = "two effects"
    share: float = 0.10
    names_nothing: bool = False

    def draft(self, rng):
        first = draw_effect(rng)
        return Draft(draw_plan(rng), [first, draw_effect(rng, but=(first.effect,))])


STRATUM = Pair()
