"""One effect of the kinds that came last: two waves a turn, leading play, an instrument's zero from a row on."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.draft import Draft
from app.proof.generator.effects.term import Request
from app.proof.strata.static._plans import draw_plan


@dataclass(frozen=True)
class Newer:
    key: str = "newer"
    title: str = "two waves a turn, leading play, a zero that jumps"
    share: float = 0.06
    names_nothing: bool = False

    def draft(self, rng):
        kind = int(rng.integers(3))
        if kind == 2:
            plan = draw_plan(rng, "tracker")
            row = int(rng.integers(plan.samples // 4, 3 * plan.samples // 4))
            return Draft(plan, [Request("instrument_zero_shift", {"from_row": row})])
        plan = draw_plan(rng)
        if kind == 1:
            return Draft(plan, [Request("backlash", {"driver": "approach", "leads": True})])
        return Draft(plan, [Request("gear_eccentricity", {"order": 2})])


STRATUM = Newer()
