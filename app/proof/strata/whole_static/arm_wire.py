"""An arm that is off everywhere, half of the time with one thing that explains most: real arm, draw-wire."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.strata.whole_static._plans import DOMINANT, draw_arm, draw_dominant, draw_run


@dataclass(frozen=True)
class ArmWire:
    key: str = "arm_wire"
    title: str = "real arm, draw-wire"
    share: float = 0.06

    def draft(self, rng):
        plan = draw_run(rng, "wire")
        return draw_arm(rng, plan, draw_dominant(rng, plan) if rng.random() < DOMINANT else None)


STRATUM = ArmWire()
