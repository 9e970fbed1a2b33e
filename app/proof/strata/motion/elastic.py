"""A joint that twists, alone or beside another law, on motions hard enough to make it ring."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.draft import Draft
from app.proof.generator.effects.term import Request
from app.proof.strata.motion._plans import draw_effect, draw_plan

#: A log that is late shows the motor and the link's torque at other times: both at once are no one's log.
ALONE = ("delay",)


@dataclass(frozen=True)
class Elastic:
    key: str = "elastic"
    title: str = "a joint that twists, its motor's angle recorded"
    share: float = 0.06
    names_nothing: bool = False

    def draft(self, rng):
        more = [draw_effect(rng, but=ALONE)] if rng.random() < 0.3 else []
        return Draft(replace(draw_plan(rng), brisk=True), [Request("elastic_joint"), *more])


STRATUM = Elastic()
