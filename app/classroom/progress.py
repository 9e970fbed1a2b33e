"""Scores -> how somebody stands in a lesson, and what is next. Pure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from app.training.exercise import Exercise
from app.training.score import ScoreCard

#: Which figure is the error, by an exercise's goal [mm].
ERRORS = {"touch": "touch_mm", "tool": "tool_mm", "relation": "meeting_mm"}
#: Tries the trend is drawn through: what somebody did long before says nothing of whether he gets better now.
_RECENT = 5
#: Points a try from which on a trend is one: below, two scores differ by chance.
STEADY = 1.0


@dataclass(frozen=True)
class Lesson:
    """A lesson of a class with its exercise.

    Args:
        id: of the lesson.
        key: of the exercise.
        exercise: None where its file has a mistake.
        problem: that mistake, in one line.
        due: seconds since 1970; 0 is never.
        without: helps that class and lesson do not allow.
        own: those that only the lesson does not.
    """

    id: str
    key: str
    exercise: Exercise | None
    problem: str = ""
    due: float = 0.0
    without: tuple[str, ...] = ()
    own: tuple[str, ...] = ()

    def title(self, language: str) -> str:
        """Its exercise's title, or its key where the exercise cannot be read."""
        return self.key if self.exercise is None else self.exercise.said(language).title


@dataclass(frozen=True)
class Standing:
    """How somebody stands in a lesson.

    Args:
        tries: finished ones, those given up among them.
        best: most points of a try; None before the first.
        passed: a try reached the pass mark.
        error: of the last try [mm]; None where there was none.
        seconds: how long the last try took.
        last: when the last try began (seconds since 1970); 0 for none.
        trend: points a try, over the last few; None with fewer than two.
        totals: points of all tries, the oldest first.
        late: the first try that passed began after the due time, or none did by now.
    """

    tries: int = 0
    best: float | None = None
    passed: bool = False
    error: float | None = None
    seconds: float | None = None
    last: float = 0.0
    trend: float | None = None
    totals: tuple[float, ...] = ()
    late: bool = False


def standing(lesson: Lesson, cards: Sequence[ScoreCard], now: float) -> Standing:
    """How somebody stands.

    Args:
        lesson: which one.
        cards: his scores in its exercise, the oldest first.
        now: seconds since 1970.
    """
    done = [card for card in cards if not card.given_up]
    good = [card for card in done if card.passed]
    by_then = good[0].begun + good[0].seconds if good else now
    late = bool(lesson.due) and by_then > lesson.due
    if not cards:
        return Standing(late=late)
    totals = tuple(card.total for card in done)
    last = cards[-1]
    goal = lesson.exercise.goal if lesson.exercise is not None else "tool"
    return Standing(
        tries=len(cards),
        best=max(totals, default=None),
        passed=bool(good),
        error=done[-1].figures.get(ERRORS[goal]) if done else None,
        seconds=last.seconds,
        last=last.begun,
        trend=trend(totals),
        totals=totals,
        late=late,
    )


def standings(lessons: Sequence[Lesson], cards: Sequence[ScoreCard], now: float) -> dict[str, Standing]:
    """How somebody stands in each lesson, by its id.

    Args:
        cards: all his scores, the oldest first.
        now: seconds since 1970.
    """
    by_key: dict[str, list[ScoreCard]] = {}
    for card in cards:
        by_key.setdefault(card.exercise, []).append(card)
    return {lesson.id: standing(lesson, by_key.get(lesson.key, []), now) for lesson in lessons}


def trend(totals: Sequence[float]) -> float | None:
    """Points a try: the slope of the straight line through the last few; None with fewer than two."""
    recent = np.array(totals[-_RECENT:], float)
    if len(recent) < 2:
        return None
    return round(float(np.polyfit(np.arange(len(recent)), recent, 1)[0]), 2)


def next_lesson(lessons: Sequence[Lesson], standings: Mapping[str, Standing]) -> Lesson | None:
    """The first lesson in order that is not passed and can be done; None where all are."""
    return next(
        (
            lesson
            for lesson in lessons
            if lesson.exercise is not None and not standings.get(lesson.id, Standing()).passed
        ),
        None,
    )
