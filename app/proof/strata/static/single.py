"""One effect of the library; base, tool and targets are open."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.strata.static._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Single:
    key: str = "single"
    title: str = "one effect"
    share: float = 0.24
    names_nothing: bool = False

    def draft(self, rng):
        plan, request = draw_effect(rng, draw_plan(rng))
        return Draft(plan, [request])


STRATUM = Single()
