"""What a search may take for granted is otherwise, one thing at a time; see docs/proof.md."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.strata.whole_motion._plans import DOMINANT, draw_arm, draw_dominant, draw_log

OTHERWISE = {
    "dry friction that fades by another law": {"fading": "arctan"},
    "dry friction as sharp as a step": {"sharpness": (1.0e-4, 5.0e-4)},
    "samples that repeat the one before": {"stale": 0.05},
    "pieces of the log missing": {"gaps": 6},
    "speeds recorded in steps": {"staircase": 0.02, "speeds": True},
    "many spikes in noise that has tails": {"spikes": 0.008, "noise_kind": "heavy"},
}


@dataclass(frozen=True)
class LogOtherwise:
    key: str = "log_otherwise"
    title: str = "real arm's log, usual assumptions broken"
    share: float = 0.08

    def draft(self, rng):
        changes = list(OTHERWISE.values())[int(rng.integers(len(OTHERWISE)))]
        plan = replace(draw_log(rng), **changes)
        return draw_arm(rng, plan, draw_dominant(rng) if rng.random() < DOMINANT else None)


STRATUM = LogOtherwise()
