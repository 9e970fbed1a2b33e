"""Sessions that are open and that no page shows: how long they stay so, and which go first where there are many.

One whose person is on his way is never closed for want of room: after a process was killed its people are more than
there is room for, each was thrown out by the next before his page's socket came, and came again. For minutes all of
them opened sessions and nobody got in.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

#: Sessions that stay open without a page: who reloads finds everything as it was. Some 3 MB each, and any page of the
#: web that a browser visits can ask a server on its own machine for as many as it likes.
MOST_IDLE = 64


class Idle:
    """Those of one process, the one that is idle for longest first. Its caller holds a lock.

    Args:
        close: told, on a thread of its own, the name of one whose time is over.
    """

    def __init__(self, close: Callable[[str], None]):
        self._close = close
        self._timers: dict[str, threading.Timer | None] = {}
        self._expected: set[str] = set()

    def begin(self, name: str, seconds: float | None, *, expected: bool = False) -> None:
        """A session is open without a page from now on.

        Args:
            name: its name.
            seconds: how long it may be; None for ever.
            expected: its person was here before and comes back to it now.
        """
        self.end(name)
        self._timers[name] = None if seconds is None else self._after(seconds, name)
        if expected:
            self._expected.add(name)
        spare = [name for name in self._timers if name not in self._expected]
        for first in spare[: max(len(spare) - MOST_IDLE, 0)]:
            self.end(first)
            self._after(0.0, first)

    def end(self, name: str) -> None:
        """A page shows it, or it is closed."""
        timer = self._timers.pop(name, None)
        self._expected.discard(name)
        if timer is not None:
            timer.cancel()

    def stop(self) -> None:
        """Nothing is closed any more."""
        for name in list(self._timers):
            self.end(name)

    def _after(self, seconds: float, name: str) -> threading.Timer:
        timer = threading.Timer(seconds, self._close, (name,))
        timer.daemon = True
        timer.start()
        return timer
