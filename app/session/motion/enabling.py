"""The enabling switch and the emergency stop: nothing moves unless the switch is held and its word is fresh.

A page says "still held" as long as a hand holds the switch. When it falls silent the switch counts as let go, and the
one who comes back has to let go and press anew: a page that froze and wakes up again moves nothing by itself.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

SILENCE = 0.16  # seconds without a word after which the switch counts as let go; with a tick it is below 0.2


class Enabling:
    """One switch with three positions rolled into two: held or not. Calls may come from any thread.

    Args:
        clock: seconds that only grow.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic):
        self._clock = clock
        self._lock = threading.Lock()
        self._held, self._heard = False, -float("inf")
        self._spent = False  # tripped: has to be let go first
        self.stopped = False
        self.trips = 0

    @property
    def live(self) -> bool:
        """True while the arm may move."""
        with self._lock:
            return self._live()

    @property
    def tripped(self) -> bool:
        """True from a silence until the switch was let go."""
        with self._lock:
            self._watch()
            return self._spent

    def beat(self, held: bool, *, anything: bool | None = None) -> bool:
        """A word from the page: whether the switch is held.

        Args:
            anything: whether the switch or any motion button is held; after a trip all must be let go.

        Returns:
            True where the arm may move from now on.
        """
        with self._lock:
            self._watch()
            self._heard = self._clock()
            if self._spent and not (held if anything is None else anything or held):
                self._spent = False
            self._held = held and not self._spent and not self.stopped
            return self._held

    def stop(self) -> None:
        """Emergency stop: latched until `release`."""
        with self._lock:
            self.stopped, self._held = True, False

    def release(self) -> None:
        """The emergency stop is released; the switch has to be pressed anew."""
        with self._lock:
            self.stopped, self._spent = False, True

    def let_go(self) -> None:
        """The page is gone."""
        with self._lock:
            self._held, self._spent = False, False

    def _live(self) -> bool:
        self._watch()
        return self._held

    def _watch(self) -> None:
        if self._held and self._clock() - self._heard > SILENCE:
            self._held, self._spent = False, True
            self.trips += 1
