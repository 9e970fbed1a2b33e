"""Nothing is wrong: whatever is named here is false."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.strata.motion._plans import draw_plan


@dataclass(frozen=True)
class Clean:
    key: str = "clean"
    title: str = "nothing wrong"
    share: float = 0.22
    names_nothing: bool = True

    def draft(self, rng):
        return Draft(draw_plan(rng))


STRATUM = Clean()
