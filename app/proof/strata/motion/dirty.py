"""A poor recorder: spikes, samples that repeat, gaps, speeds in steps; nothing wrong with the arm, or one thing."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.draft import Draft
from app.proof.strata.motion._plans import draw_effect, draw_plan

DIRT = (
    {"spikes": 0.001},
    {"spikes": 0.005, "noise_kind": "heavy"},
    {"stale": 0.05},
    {"gaps": 6},
    {"staircase": 0.02, "speeds": True},
    {"spikes": 0.001, "gaps": 3, "stale": 0.02},
)


@dataclass(frozen=True)
class Dirty:
    key: str = "dirty"
    title: str = "spikes, stale samples, gaps, speeds in steps"
    share: float = 0.08
    names_nothing: bool = False

    def draft(self, rng):
        plan = replace(draw_plan(rng), **DIRT[int(rng.integers(len(DIRT)))])
        return Draft(plan, [] if rng.random() < 0.6 else [draw_effect(rng)])


STRATUM = Dirty()
