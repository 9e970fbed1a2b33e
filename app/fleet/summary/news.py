"""What the last run brought: arms that were not there, effects an arm did not have, effects it has no more."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from app.fleet.summary.seen import Seen, What


@dataclass(frozen=True)
class News:
    """Beside all earlier runs.

    Args:
        recordings: read in the last run.
        arms: that had no recording before.
        come: (arm, effect) that was in none of the arm's recordings before.
        gone: (arm, effect) that was in the arm's newest recording before and is in none read now.
    """

    recordings: int
    arms: tuple[str, ...]
    come: tuple[tuple[str, What], ...]
    gone: tuple[tuple[str, What], ...]


def news(all_seen: Iterable[Seen], run: int) -> News | None:
    """None where there was no run before."""
    before: dict[str, set[What]] = {}
    newest: dict[str, Seen] = {}
    now: dict[str, set[What]] = {}
    count = 0
    for one in all_seen:
        if one.run == run:
            count += 1
            now.setdefault(one.arm, set()).update(one.found)
            continue
        before.setdefault(one.arm, set()).update(one.found)
        if one.arm not in newest or one.recorded > newest[one.arm].recorded:
            newest[one.arm] = one
    if not before:
        return None

    def listed(pairs: Iterable[tuple[str, What]]) -> tuple[tuple[str, What], ...]:
        return tuple(sorted(pairs, key=lambda pair: (pair[0], pair[1].effect, str(pair[1].where))))

    old = [arm for arm in now if arm in before]
    return News(
        count,
        tuple(sorted(set(now) - set(before))),
        listed((arm, what) for arm in old for what in now[arm] - before[arm]),
        listed((arm, what) for arm in old for what in set(newest[arm].found) - now[arm]),
    )
