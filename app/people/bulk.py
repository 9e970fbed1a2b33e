"""How many bytes somebody has sent lately: counted here by the byte, in the database by the piece."""

from __future__ import annotations

import threading

from app.people.limits import Limit
from app.people.tries import Tries

#: Bytes of a piece: a folder of small files is no write into the database for each of them, and what a person who goes
#: from one process to another is not asked for is less than this.
PIECE = 10_000_000


class Bulk:
    """Counts bytes, over all processes that share a database.

    Args:
        tries: the database's counts.
        limit: so many bytes in so many seconds.
        piece: bytes that are counted at once.
    """

    def __init__(self, tries: Tries, limit: Limit, piece: int = PIECE):
        self._tries, self._limit, self._piece = tries, Limit(limit.most // piece, limit.seconds), piece
        self._begun: dict[str, int] = {}  # who -> bytes of a piece that is not full
        self._lock = threading.Lock()

    def count(self, who: str, amount: int) -> bool:
        """Counts what somebody sends; False, and not counted, where it would be too much. Raises StorageError."""
        with self._lock:
            pieces, begun = divmod(self._begun.get(who, 0) + amount, self._piece)
            if pieces and not self._tries.count(self._limit, "sent", who, amount=pieces):
                return False
            self._begun[who] = begun
            return True
