"""One effect of the library in an arm that is as described."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.strata.motion._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Single:
    key: str = "single"
    title: str = "one effect"
    share: float = 0.26
    names_nothing: bool = False

    def draft(self, rng):
        return Draft(draw_plan(rng), [draw_effect(rng)])


STRATUM = Single()
