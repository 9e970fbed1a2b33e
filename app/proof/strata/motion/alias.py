"""Every torque too large by one factor, as if the whole arm were heavier."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.generator.effects.term import Request
from app.proof.strata.motion._plans import draw_plan


@dataclass(frozen=True)
class Alias:
    key: str = "alias"
    title: str = "a common scale of all torques"
    share: float = 0.04
    names_nothing: bool = False

    def draft(self, rng):
        scale = {"scale": float(rng.uniform(0.05, 0.15))}
        return Draft(draw_plan(rng), [Request("torque_constant", {"common": True}, scale)])


STRATUM = Alias()
