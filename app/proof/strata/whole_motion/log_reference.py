"""A load taken up since a reference log of the same arm; at times nothing was."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.strata.whole_motion._plans import draw_arm, draw_load, draw_log


@dataclass(frozen=True)
class LogReference:
    key: str = "log_reference"
    title: str = "load against a reference log"
    share: float = 0.12

    def draft(self, rng):
        request = draw_load(rng) if rng.random() < 0.75 else None
        return replace(draw_arm(rng, draw_log(rng), request), referenced=True, share=0.5)


STRATUM = LogReference()
