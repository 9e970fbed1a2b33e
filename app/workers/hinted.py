"""Hints that stand in the message line of one session, and who watches it: what its page shows of its trainer."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from app.classroom.hints import Hint, Hints
from app.errors import StorageError

_LOG = logging.getLogger(__name__)


class Hinted:
    """The hints of one session. Calls may come from any thread.

    Args:
        kept: where they are kept; None on a server without classes.
        news: called when what the page shows has changed.
    """

    def __init__(self, kept: Hints | None, news: Callable[[], None]):
        self._kept, self._news = kept, news
        self._lock = threading.Lock()
        self._waiting: tuple[Hint, ...] = ()
        self._away: set[int] = set()  # put away here; the database may not know yet
        self._shown: set[int] = set()
        self._watching = 0

    @property
    def first(self) -> Hint | None:
        """The oldest that was not put away."""
        waiting = self._waiting
        return waiting[0] if waiting else None

    @property
    def count(self) -> int:
        """How many wait, that one among them."""
        return len(self._waiting)

    @property
    def watched(self) -> bool:
        """True while a trainer watches."""
        return self._watching > 0

    def bring(self, hints: Sequence[Hint]) -> None:
        """These are not put away yet, the oldest first."""
        with self._lock:
            now = tuple(hint for hint in hints if hint.id not in self._away)
            same = [hint.id for hint in now] == [hint.id for hint in self._waiting]
            self._waiting = now
        if not same:
            self._news()

    def got(self, id: int) -> None:
        """The page shows it."""
        hint = self._one(id)
        if hint is None or id in self._shown or self._kept is None:
            return
        self._shown.add(id)
        try:
            self._kept.shown(id, hint.owner)
        except StorageError as error:  # putting it away says so once more
            self._shown.discard(id)
            _LOG.warning("that a hint was shown was not kept: %s", error)

    def put_away(self, id: int) -> None:
        """He has read it: the next one stands there. Where that cannot be kept, the hint stays."""
        hint = self._one(id)
        if hint is None or self._kept is None:
            return
        try:
            self._kept.put_away(id, hint.owner)
        except StorageError as error:
            _LOG.warning("that a hint was put away was not kept: %s", error)
            return
        with self._lock:
            self._away.add(id)
            self._waiting = tuple(other for other in self._waiting if other.id != id)
        self._news()

    @contextmanager
    def watching(self) -> Iterator[None]:
        """A trainer watches while this lasts; the page says so."""
        with self._lock:
            self._watching += 1
        self._news()
        try:
            yield
        finally:
            with self._lock:
                self._watching -= 1
            self._news()

    def _one(self, id: int) -> Hint | None:
        return next((hint for hint in self._waiting if hint.id == id), None)
