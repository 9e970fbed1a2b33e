"""An effect that no library holds: a name given to it is false."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.generator.motion.cell import OUTSIDE
from app.proof.strata.motion._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Outside:
    key: str = "outside"
    title: str = "an effect that no library holds"
    share: float = 0.12
    names_nothing: bool = True

    def draft(self, rng):
        return Draft(draw_plan(rng), [draw_effect(rng, package=OUTSIDE)])


STRATUM = Outside()
