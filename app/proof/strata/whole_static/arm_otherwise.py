"""What a search may take for granted is otherwise, one thing at a time; see docs/proof.md."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.strata.whole_static._plans import DOMINANT, draw_arm, draw_dominant, draw_run

STEPPING = ("base_shift", "tool_slip", "joint_slip", "instrument_zero_shift")
OTHERWISE = {
    "rows not in the order of time": {"shuffled": True},
    "steps that take six rows": {"settling": 6},
    "a base that leans by two degrees": {"lean": 0.035},
    "a third of the rows reached by way of points not told": {"unseen": 0.33},
    "repeated poses that miss themselves, without a label": {
        "repeats": 12,
        "scatter": 1e-4,
        "labelled": False,
    },
    "noise that remembers": {"noise_kind": "coloured"},
    "a reading in twenty is wrong": {"outliers": 0.06},
}


@dataclass(frozen=True)
class ArmOtherwise:
    key: str = "arm_otherwise"
    title: str = "real arm, usual assumptions broken"
    share: float = 0.08

    def draft(self, rng):
        changes = list(OTHERWISE.values())[int(rng.integers(len(OTHERWISE)))]
        plan = replace(draw_run(rng, "tracker"), **changes)
        dominant = draw_dominant(rng, plan) if rng.random() < DOMINANT else None
        while plan.shuffled and dominant and dominant.effect in STEPPING:
            dominant = draw_dominant(rng, plan)  # a row from which something holds would not mean anything
        whole = draw_arm(rng, plan, dominant)
        return replace(whole, masses=0.3) if rng.random() < 0.15 else whole


STRATUM = ArmOtherwise()
