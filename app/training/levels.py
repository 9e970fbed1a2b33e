"""The levels of a lesson: the same task again, with fewer helps each time.

guided   buttons that touch the spike, propose the next touch or run a procedure by themselves; distance as a number
light    none of these: close views, the drag handle, and the light at contact
eye      close views alone: whether the tip touches is seen, or it is not known

A help that an exercise does not allow at all is missing on every level, so an exercise may begin further down.
"""

from __future__ import annotations

from collections.abc import Collection

import msgspec

from app.session.actions import Begin
from app.training.exercise import Exercise

#: Level -> helps it takes away, the easiest level first.
LEVELS: dict[str, tuple[str, ...]] = {
    "guided": (),
    "light": ("touch", "next_touch", "distance"),
    "eye": ("touch", "next_touch", "distance", "light", "handle"),
}
#: What doing without each help is worth of the whole, together 1: the buttons do most of the work.
_WORTH = {"touch": 0.4, "next_touch": 0.2, "distance": 0.2, "light": 0.15, "handle": 0.05}
#: Points of 100 from which on a lesson is passed: accuracy alone, or care alone, gives less.
PASS = 60.0


def helps(exercise: Exercise, without: Collection[str]) -> frozenset[str]:
    """Helps that are there in an attempt.

    Args:
        exercise: whose `allowed` counts.
        without: what level and class take away.
    """
    allowed = msgspec.structs.asdict(exercise.allowed)
    counted = ("touch",) if exercise.goal == "relation" else tuple(_WORTH)
    return frozenset(name for name in counted if allowed[name] and name not in without)


def levels_of(exercise: Exercise) -> tuple[str, ...]:
    """The levels of an exercise that differ, the easiest first."""
    found: dict[frozenset[str], str] = {}
    for level, without in reversed(LEVELS.items()):  # of two that are the same the harder name holds
        found.setdefault(helps(exercise, without), level)
    return tuple(level for level in LEVELS if level in found.values())


def level_of(begun: Begin) -> str:
    """The hardest level whose missing helps all are missing in this attempt."""
    fitting = [level for level, without in LEVELS.items() if set(without) <= set(begun.without)]
    return fitting[-1]


def alone(exercise: Exercise, without: Collection[str]) -> float:
    """How much of the work was the trainee's own, 0 to 1: all of it where no help was there."""
    there = helps(exercise, without)
    if exercise.goal == "relation":
        return float(not there)
    return 1.0 - sum(_WORTH[name] for name in there)


def next_up(exercise: Exercise, level: str, order: Collection[Exercise]) -> tuple[Exercise, str]:
    """What comes after a lesson that was passed: its next level, else the next exercise from its first level on."""
    mine = levels_of(exercise)
    harder = [other for other in mine if list(LEVELS).index(other) > list(LEVELS).index(level)]
    if harder:
        return exercise, harder[0]
    keys = [other.key for other in order]
    at = keys.index(exercise.key) + 1 if exercise.key in keys else 0
    following = list(order)[at % len(keys)]
    return following, levels_of(following)[0]
