"""Play that stands out, in poses come to from either side; at times made up for by more than there is."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.generator.effects.term import Request
from app.proof.strata.whole_static._plans import draw_arm, draw_run


@dataclass(frozen=True)
class ArmPlay:
    key: str = "arm_play"
    title: str = "real arm, play in repeats from either side"
    share: float = 0.08

    def draft(self, rng):
        plan = draw_run(rng, "tracker")
        style = str(rng.choice(["either_side", "either_side", "apart"]))
        plan = replace(plan, repeats=max(plan.samples // 6, 8), repeats_as=style)
        whole = draw_arm(rng, plan, Request("backlash", {"driver": "approach"}))
        return replace(whole, build=replace(whole.build, over=0.5))


STRATUM = ArmPlay()
