"""In which order candidates are tried."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.score import Scores

#: Candidates looked at before a round is given up.
TRIES = 8
_CLOSE = 30  # candidates at the top that are ranked at all
_ALIKE = 0.05  # difference of -log10 p below which two candidates count as exactly alike


def by_rank(order: np.ndarray, scores: Scores) -> list[int]:
    """By score; among candidates that explain exactly alike, the one a person would name first."""
    best: list[int] = []
    left = list(order[:_CLOSE])
    while left:
        top = scores.score[left[0]]
        alike = [i for i in left if top - scores.score[i] < _ALIKE and top > 0]
        alike = alike or left[:1]
        alike.sort(key=lambda i: (scores.candidates[i].effect.rank, -scores.score[i]))
        best += alike
        left = [i for i in left if i not in alike]
    return best
