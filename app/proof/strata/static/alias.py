"""Effects that base, tool or targets swallow whole: naming another effect would be false."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.proof.draft import Draft
from app.proof.generator.effects.term import Request
from app.proof.strata.static._plans import draw_plan


@dataclass(frozen=True)
class Alias:
    key: str = "alias"
    title: str = "exact aliases of base and tool"
    share: float = 0.05
    names_nothing: bool = False

    def draft(self, rng):
        kind = str(rng.choice(["touch", "tracker"]))
        plan = replace(draw_plan(rng, kind), sessions=1)
        hidden = [Request("joint_zero", {"joint": 1}), Request("link_length", {"link": 1, "axis": "d"})]
        if kind == "touch":
            hidden.append(Request("touch_indentation"))
        return Draft(plan, [hidden[int(rng.integers(len(hidden)))]])


STRATUM = Alias()
