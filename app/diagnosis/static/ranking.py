"""In which order candidates are tried."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.score import Scores

#: Candidates looked at before a round is given up.
TRIES = 8
_CLOSE = 30  # candidates at the top that are ranked at all
_ALIKE = 0.05  # difference of -log10 p below which two candidates count as exactly alike


def by_rank(scores: Scores, rows: int) -> list[int]:
    """By score; among candidates that explain exactly alike, the one a person would name first.

    A step's row was chosen among all `rows`, which is worth as many tries: a slip in the first rows does not
    overtake the zero that it all but is.
    """
    stepping = np.array(["from_row" in candidate.place.where for candidate in scores.candidates])
    worth = scores.score - np.where(stepping, np.log10(max(rows, 1)), 0.0)
    best: list[int] = []
    left = list(np.argsort(-worth, kind="stable")[:_CLOSE])
    while left:
        top = worth[left[0]]
        alike = [i for i in left if top - worth[i] < _ALIKE and top > 0]
        alike = alike or left[:1]
        alike.sort(key=lambda i: (scores.candidates[i].effect.rank, -worth[i]))
        best += alike
        left = [i for i in left if i not in alike]
    return best
