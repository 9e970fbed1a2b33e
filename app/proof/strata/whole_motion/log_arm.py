"""Links off by a twentieth to a fifth, friction of every kind in every joint, one thing dominant or none."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.strata.whole_motion._plans import DOMINANT, draw_arm, draw_dominant, draw_log


@dataclass(frozen=True)
class LogArm:
    key: str = "log_arm"
    title: str = "real arm's log"
    share: float = 0.36

    def draft(self, rng):
        return draw_arm(rng, draw_log(rng), draw_dominant(rng) if rng.random() < DOMINANT else None)


STRATUM = LogArm()
