"""What an event's columns share with everything else, piece by piece of the log: every window is a difference of sums.

Products with the design's columns are worked out once for each noise, when a selection first has them; no selection is
looked at row by row.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.diagnosis.models.dynamic.design import TorqueDesign
from app.diagnosis.regression.evidence import Posterior
from app.diagnosis.thresholds.events import EDGE, LONGEST

PIECES = 60  # of the log: edges of events are looked for at their ends first, and moved continuously then


class Pieces:
    """One joint.

    Args:
        white: (rows, d) whitened columns of events, as if they lasted all the time.
        y: (rows,) whitened torque.
        count: of pieces.
    """

    def __init__(self, white: np.ndarray, y: np.ndarray, count: int):
        self.white = white
        self.edges = np.linspace(0, len(white), count + 1).astype(int)
        self.gram = np.stack([white[s].T @ white[s] for s in self._slices()])
        self.right = np.stack([white[s].T @ y[s] for s in self._slices()])
        self._at: dict[int, int] = {}
        self._cross = np.zeros((count, white.shape[1], 0))

    def _slices(self) -> list[slice]:
        return [slice(a, b) for a, b in zip(self.edges[:-1].tolist(), self.edges[1:].tolist(), strict=True)]

    def cross(self, places: Sequence[int], columns: np.ndarray) -> np.ndarray:
        """(pieces, d, k) products with some of the joint's whitened columns (rows, all), by their places there."""
        new = [k for k in places if k not in self._at]
        if new:
            taken = columns[:, new]
            more = np.stack([self.white[s].T @ taken[s] for s in self._slices()])
            self._at.update({k: self._cross.shape[2] + i for i, k in enumerate(new)})
            self._cross = np.concatenate([self._cross, more], axis=2)
        return self._cross[:, :, [self._at[k] for k in places]]


def beside(
    pieces: Sequence[Pieces], design: TorqueDesign, found: Posterior
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sums before each edge of products of events with themselves, a selection's columns and what it leaves.

    Returns:
        (p + 1, d, d), (p + 1, d, a) and (p + 1, d), all joints together.
    """
    at = {int(c): i for i, c in enumerate(found.columns)}
    count, d = pieces[0].right.shape
    gram, cross, right = np.zeros((count, d, d)), np.zeros((count, d, len(at))), np.zeros((count, d))
    for piece, ids, white in zip(pieces, design.at, design.white, strict=True):
        here = [k for k, c in enumerate(ids.tolist()) if c in at]
        places = np.array([at[int(ids[k])] for k in here], int)
        own = piece.cross(here, white)
        gram += piece.gram
        cross[:, :, places] += own
        right += piece.right - own @ found.weights[places]
    return from_start(gram), from_start(cross), from_start(right)


def from_start(values: np.ndarray) -> np.ndarray:
    """(p + 1, ...) sums over the pieces before each edge."""
    return np.concatenate([np.zeros_like(values[:1]), np.cumsum(values, axis=0)])


def windows() -> tuple[np.ndarray, np.ndarray]:
    """First and last piece of every window that is tried."""
    longest = int(LONGEST * PIECES)
    pairs = [(x, y) for x in range(PIECES) for y in range(x + 2, min(PIECES, x + longest) + 1)]
    first, last = np.array(pairs).T
    return first, last


def spells(first: np.ndarray, share: np.ndarray, *, over: bool) -> tuple[np.ndarray, np.ndarray]:
    """First and last piece of what begins and stays, or, where it may be over again, lasts for a while.

    Args:
        first: pieces at which it may begin or end; share: (pieces + 1,) of the log's motion before each.
        over: whether it may end before the log does.
    """
    ends = [*(first.tolist() if over else []), PIECES]
    pairs = [(x, y) for x in first.tolist() for y in ends if y > x and share[y] - share[x] >= EDGE]
    begin, last = np.array(pairs, int).reshape(-1, 2).T
    return begin, last
