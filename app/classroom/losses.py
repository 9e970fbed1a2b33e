"""Scores of one lesson -> where points are lost. Pure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from app.training.score import ScoreCard


@dataclass(frozen=True)
class Lost:
    """One part of a score, over all tries.

    Args:
        part: its key.
        points: of 100 that are lost by it a try, on average.
        of: points it is worth.
        worst: share of the tries in which it lost more than half of what it is worth.
    """

    part: str
    points: float
    of: float
    worst: float


@dataclass(frozen=True)
class Losses:
    """Where points are lost in a lesson.

    Args:
        tries, people: finished tries, and of how many.
        given_up: tries that were given up.
        mean, median: points of the last try of each.
        parts: the most costly first.
        advice: (code, people who were told so after their last try), the most frequent first.
        wrong: (what was said to be wrong, how often) where that was not what was.
    """

    tries: int
    people: int
    given_up: int
    mean: float | None
    median: float | None
    parts: tuple[Lost, ...]
    advice: tuple[tuple[str, int], ...]
    wrong: tuple[tuple[str, int], ...]


def losses(cards: Mapping[str, Sequence[ScoreCard]]) -> Losses:
    """Where points are lost.

    Args:
        cards: person -> his scores in one exercise, the oldest first.
    """
    done = {who: [c for c in his if not c.given_up] for who, his in cards.items()}
    lasts = [his[-1] for his in done.values() if his]
    every = [card for his in done.values() for card in his]
    shares: dict[str, list[tuple[float, float]]] = {}
    for card in every:
        weight = sum(part.weight for part in card.parts)
        for part in card.parts:
            shares.setdefault(part.key, []).append((1.0 - part.value, 100.0 * part.weight / weight))
    parts = [
        Lost(
            key,
            round(float(np.mean([lost * of for lost, of in found])), 1),
            round(float(np.mean([of for _, of in found])), 1),
            round(float(np.mean([lost > 0.5 for lost, _ in found])), 2),
        )
        for key, found in shares.items()
    ]
    totals = [card.total for card in lasts]
    return Losses(
        tries=len(every),
        people=len(lasts),
        given_up=sum(len(his) for his in cards.values()) - len(every),
        mean=round(float(np.mean(totals)), 1) if totals else None,
        median=round(float(np.median(totals)), 1) if totals else None,
        parts=tuple(sorted(parts, key=lambda lost: -lost.points)),
        advice=tuple(Counter(a.code for card in lasts for a in card.advice).most_common()),
        wrong=tuple(
            Counter(
                card.answer or "unsaid"
                for card in every
                if card.right_answer and card.answer != card.right_answer
            ).most_common()
        ),
    )
