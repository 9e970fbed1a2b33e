"""Which arms share which effect."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from app.fleet.summary.seen import Seen, Value, What

#: An effect counts as an arm's where it stands in this share of the arm's recordings: one in ten may be chance.
OFTEN = 0.5


@dataclass(frozen=True)
class Shared:
    """An effect and the arms that have it.

    Args:
        what: the effect and its place.
        arms: those that have it in at least half their recordings, in the order of their names.
        typical: first number of the effect: median over the arms, and median distance from it as a standard error.
    """

    what: What
    arms: tuple[str, ...]
    typical: Value | None


def shared(all_seen: Iterable[Seen]) -> list[Shared]:
    """Effects, those of most arms first."""
    recordings: dict[str, int] = {}
    holds: dict[What, dict[str, list[tuple[Value, ...]]]] = {}
    for one in all_seen:
        recordings[one.arm] = recordings.get(one.arm, 0) + 1
        for what, values in one.found.items():
            holds.setdefault(what, {}).setdefault(one.arm, []).append(values)
    out = []
    for what, by_arm in holds.items():
        arms = {arm: got for arm, got in by_arm.items() if len(got) >= OFTEN * recordings[arm]}
        if arms:
            out.append(Shared(what, tuple(sorted(arms)), _typical(list(arms.values()))))
    return sorted(out, key=lambda s: (-len(s.arms), s.what.effect, str(s.what.where)))


def _typical(by_arm: list[list[tuple[Value, ...]]]) -> Value | None:
    first = [[values[0] for values in got if values] for got in by_arm]
    first = [got for got in first if got]
    if not first:
        return None
    medians = np.array([np.median([v.value for v in got]) for got in first])
    middle = float(np.median(medians))
    around = float(np.median(np.abs(medians - middle))) * 1.4826  # median distance -> sigma of a normal law
    spread = around if len(medians) > 1 else first[0][0].std
    return Value(first[0][0].name, middle, spread, first[0][0].unit)
