"""The description's masses are up to a fifth off."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.generator.effects.term import Request
from app.proof.strata.static._plans import draw_plan


@dataclass(frozen=True)
class Masses:
    key: str = "masses"
    title: str = "wrong nominal masses"
    share: float = 0.05
    names_nothing: bool = False

    def draft(self, rng):
        plan = draw_plan(rng)
        if rng.random() < 0.4:
            return Draft(plan, wrong_masses=0.2)
        return Draft(plan, [Request("joint_compliance")], wrong_masses=0.2)


STRATUM = Masses()
