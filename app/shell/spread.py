"""Which worker each browser belongs to: the one it came to first, until that one ends."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from dataclasses import dataclass

_IDLE = 900.0  # seconds without a connection after which a browser is forgotten
_OPENING = 5.0  # seconds in which a worker is taken to open the session of a browser it was given
_MOST_KNOWN = 100_000  # browsers remembered
_NONE = -1  # no worker


@dataclass
class Known:
    """A browser: its worker, its open connections, when it was last heard of and last given to a worker (monotonic)."""

    worker: int
    open: int = 0
    last: float = 0.0
    came: float = 0.0


class Spread:
    """Browsers over workers.

    Args:
        count: of workers.
        ready: tells whether a worker runs.
    """

    def __init__(self, count: int, ready: Callable[[int], bool]):
        self._count, self._ready = count, ready
        self.known: dict[str, Known] = {}
        self._strangers = [0] * count

    @property
    def ready(self) -> bool:
        """True while any worker runs."""
        return any(self._ready(number) for number in range(self._count))

    def stranger(self, number: int, count: int = 1) -> None:
        """A browser without a cookie is at this worker; -1: it is there no more.

        Until it has got its cookie nobody else knows of it: a class that came in at one moment would all be given to
        the same worker.
        """
        self._strangers[number] += count

    def find(self, key: str) -> Known | None:
        """What is remembered of a browser; None for one without a cookie."""
        if not key:
            return None
        return self.known.get(key) or self.remember(key, self._emptiest())

    def remember(self, key: str, number: int) -> Known:
        """A browser belongs to this worker from now on."""
        if len(self.known) >= _MOST_KNOWN:
            self._forget()
        known = self.known.setdefault(key, Known(_NONE))
        known.last = time.monotonic()
        _give(known, number)
        return known

    def worker(self, known: Known | None, refused: Collection[int]) -> int:
        """The worker to ask: the browser's own where it runs, else another, which is its own from now on.

        Args:
            known: None for a browser without a cookie.
            refused: workers that do not answer.
        """
        number = _NONE if known is None else known.worker
        if number == _NONE or number in refused or not self._ready(number):
            number = self._emptiest(refused)
            if known is not None:
                _give(known, number)
        return number

    def ended(self, number: int) -> None:
        """A worker has ended: its browsers are spread over all, the one that takes its place among them."""
        for known in self.known.values():
            if known.worker == number:
                known.worker = _NONE

    def _emptiest(self, but: Collection[int] = ()) -> int:
        """The worker that runs and has the fewest browsers to open sessions for; of several, the fewest of late.

        Those of a worker that ended come at once, and to open a session takes more than to have one open: a worker
        that was just started would get all of them, and the last would wait for the others.
        """
        now = time.monotonic()
        here = [n for n in range(self._count) if self._ready(n) and n not in but]
        counts = {n: [self._strangers[n], self._strangers[n]] for n in here}
        for known in self.known.values():
            if known.worker in counts and (known.open or known.last > now - _IDLE):
                counts[known.worker][0] += known.came > now - _OPENING
                counts[known.worker][1] += 1
        return min(counts, key=lambda n: counts[n]) if counts else 0

    def _forget(self) -> None:
        before = time.monotonic() - _IDLE
        idle = [key for key, known in self.known.items() if not known.open and known.last < before]
        for key in idle or list(self.known)[: _MOST_KNOWN // 10]:
            del self.known[key]


def _give(known: Known, number: int) -> None:
    if known.worker != number:
        known.worker, known.came = number, time.monotonic()
