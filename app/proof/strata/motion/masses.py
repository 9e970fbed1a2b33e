"""The description's masses and centres are up to five percent off."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.strata.motion._plans import draw_effect, draw_plan


@dataclass(frozen=True)
class Masses:
    key: str = "masses"
    title: str = "wrong nominal masses"
    share: float = 0.06
    names_nothing: bool = False

    def draft(self, rng):
        requests = [draw_effect(rng, but=("payload", "torque_constant"))] if rng.random() < 0.6 else []
        return Draft(draw_plan(rng), requests, wrong_masses=0.05)


STRATUM = Masses()
