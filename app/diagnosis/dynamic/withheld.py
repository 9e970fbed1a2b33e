"""Laws of a selection that explain a good part of a log and have no name: structure, whatever it is.

One that is large by itself counts, and so do several on one joint that only together stand above chance: a spring and
two waves that stand for the same curve take each other's evidence, and none of them is the law of that joint.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.thresholds.naming_logs import NAME, SHARE

if TYPE_CHECKING:
    from app.diagnosis.dynamic.names import Member
    from app.diagnosis.dynamic.solution import Solution
    from app.diagnosis.dynamic.study import Study


def withheld(study: Study, solution: Solution, found: Sequence[Member], mismatch: float) -> list[Member]:
    """Members without a name that are structure, alone or together with others of their joint.

    Args:
        mismatch: mean square of `before` above noise [Nm^2].
    """
    unnamed = [m for m in found if m.asks_for_a_name and not m.named]
    alone = [m for m in unnamed if m.gain >= NAME and m.share >= SHARE]
    joints = {m.candidate.place.where["joint"] for m in unnamed if "joint" in m.candidate.place.where}
    sets = [[m for m in unnamed if m.candidate.place.where.get("joint") == joint] for joint in sorted(joints)]
    together = [m for some in sets if _together(study, solution, some, mismatch) for m in some]
    return [*alone, *(m for m in together if m not in alone)]


def _together(study: Study, solution: Solution, some: Sequence[Member], mismatch: float) -> bool:
    """True where the log cannot do without all of these at once."""
    own = {m.group for m in some if not study.label(m.group).whole and not m.held}
    if len(own) < 2:
        return False
    rest = {g: v for g, v in study.selection.items() if g not in own}
    if study.evidence.score(study.selection) - study.evidence.score(rest) < NAME:
        return False
    columns = np.concatenate([study.group(g).columns for g in sorted(own)])
    left = study.design.y - study.design.prediction(solution.columns, solution.weights)
    without = left + study.design.prediction(columns, solution.of(columns)[0])
    return float(np.mean(without**2) - np.mean(left**2)) >= SHARE * mismatch
