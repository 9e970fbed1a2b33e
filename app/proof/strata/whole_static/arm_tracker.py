"""An arm that is off everywhere, half of the time with one thing that explains most: real arm, tracker."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.strata.whole_static._plans import DOMINANT, draw_arm, draw_dominant, draw_run


@dataclass(frozen=True)
class ArmTracker:
    key: str = "arm_tracker"
    title: str = "real arm, tracker"
    share: float = 0.22

    def draft(self, rng):
        plan = draw_run(rng, "tracker")
        return draw_arm(rng, plan, draw_dominant(rng, plan) if rng.random() < DOMINANT else None)


STRATUM = ArmTracker()
