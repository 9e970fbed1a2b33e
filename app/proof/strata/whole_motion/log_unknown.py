"""What stands out is a law that no library holds: a name given to it is false."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.strata.whole_motion._plans import draw_arm, draw_log, draw_unknown


@dataclass(frozen=True)
class LogUnknown:
    key: str = "log_unknown"
    title: str = "real arm's log, an effect that no library holds"
    share: float = 0.08

    def draft(self, rng):
        return draw_arm(rng, draw_log(rng), draw_unknown(rng))


STRATUM = LogUnknown()
