"""The way an arm went between two rests, a pose every tenth of a second: kept with the move while an exercise runs."""

from __future__ import annotations

import time

import numpy as np

from app.session.state import as_tuple

_EVERY = 0.1  # seconds
_MOST = 1200  # poses: two minutes without a rest


class Trail:
    """Collects poses, and gives them once."""

    def __init__(self):
        self._poses: list[tuple[float, ...]] = []
        self._at = 0.0

    def passing(self, q: np.ndarray) -> None:
        """The arm is at q (n,)."""
        now = time.monotonic()
        if now - self._at >= _EVERY and len(self._poses) < _MOST:
            self._at = now
            self._poses.append(as_tuple(q))

    def take(self) -> tuple[tuple[float, ...], ...]:
        """What was collected; it begins anew."""
        poses, self._poses = tuple(self._poses), []
        return poses
