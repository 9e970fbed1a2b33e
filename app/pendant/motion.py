"""How the arm gets from pose to pose, tick by tick: generators for `Worker.animate`."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import numpy as np

#: Quickest joint of a shown motion [rad/s or m/s], and the shortest and longest it may take [s].
SPEED, SHORTEST, LONGEST = 1.6, 0.35, 2.2


def move(start: np.ndarray, end: np.ndarray, show: Callable[[np.ndarray], None]) -> Iterator[None]:
    """All joints together, smoothly from rest to rest, by the clock and not by counting ticks.

    Args:
        start, end: (n,) [rad or m].
        show: called with each pose on the way; the last one is exactly `end`.
    """
    longest = float(np.abs(end - start).max(initial=0.0))
    duration = float(np.clip(longest / SPEED, SHORTEST, LONGEST)) if longest > 1e-9 else 0.0
    begun = time.monotonic()
    while (passed := time.monotonic() - begun) < duration:
        share = passed / duration
        show(start + (end - start) * share * share * (3.0 - 2.0 * share))
        yield
    show(end)


def pause(seconds: float) -> Iterator[None]:
    """Nothing, for a while."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        yield
