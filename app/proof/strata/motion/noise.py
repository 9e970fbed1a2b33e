"""Noise that is coloured or heavy-tailed, with and without an effect."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.draft import Draft
from app.proof.strata.motion._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Noise:
    key: str = "noise"
    title: str = "coloured and heavy-tailed noise"
    share: float = 0.06
    names_nothing: bool = False

    def draft(self, rng):
        plan = replace(draw_plan(rng), noise_kind=str(rng.choice(["coloured", "heavy"])))
        return Draft(plan, [draw_effect(rng)] if rng.random() < 0.5 else [])


STRATUM = Noise()
