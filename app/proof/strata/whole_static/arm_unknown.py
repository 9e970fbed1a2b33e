"""What stands out is a law that no library holds: a name given to it is false."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.strata.whole_static._plans import draw_arm, draw_run, draw_unknown


@dataclass(frozen=True)
class ArmUnknown:
    key: str = "arm_unknown"
    title: str = "real arm, an effect that no library holds"
    share: float = 0.08

    def draft(self, rng):
        plan = draw_run(rng, str(rng.choice(["tracker", "tracker", "touch"])))
        return draw_arm(rng, plan, draw_unknown(rng, plan))


STRATUM = ArmUnknown()
