"""How much somebody has done lately, in the memory of one process: for what is counted many times a second."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict

from app.people.limits import Limit

_REMEMBERED = 10_000  # keys; the one longest silent is forgotten first


class Meter:
    """Counts by key; what was counted runs off evenly over the limit's seconds. From any thread.

    Args:
        limit: so many in so many seconds.
    """

    def __init__(self, limit: Limit):
        self._limit = limit
        self._used: OrderedDict[str, tuple[float, float]] = OrderedDict()  # key -> used, when that was
        self._lock = threading.Lock()

    def count(self, key: str, amount: float = 1.0) -> bool:
        """Counts what somebody does; False, and not counted, where it would be too much."""
        now, limit = time.monotonic(), self._limit
        with self._lock:
            used, at = self._used.pop(key, (0.0, now))
            used = max(0.0, used - (now - at) * limit.most / limit.seconds)
            fits = used + amount <= limit.most
            self._used[key] = (used + amount if fits else used, now)
            if len(self._used) > _REMEMBERED:
                self._used.popitem(last=False)
            return fits
