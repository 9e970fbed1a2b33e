"""How often somebody has done something lately, counted in the database: all processes of all servers together."""

from __future__ import annotations

import hashlib
import time

from sqlalchemy import delete, func, insert, select

from app.people.limits import Limit
from app.people.tables import TRIES
from app.session.database import Database

_KEPT = 3600.0  # seconds: longer than any limit that is counted here looks back


class Tries:
    """Counts of a database.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database
        self._tidied = time.monotonic()

    def count(self, limit: Limit, *what: str, amount: int = 1) -> bool:
        """Counts what somebody does; False, and not counted, where it would be more than the limit allows.

        Args:
            limit: how many in how many seconds, at most an hour.
            what: who does what, from where; kept as a hash.
            amount: how many at once.
        """
        key = hashlib.sha256("\0".join(what).encode()).hexdigest()
        now = time.time()
        # A clock that was set back must lock nobody out: what lies ahead of it is forgotten, too.
        recent = TRIES.c.at.between(now - limit.seconds, now + limit.seconds)
        with self._database.begin() as connection:
            if connection.dialect.name == "postgresql":  # SQLite lets one write at a time by itself
                connection.execute(select(func.pg_advisory_xact_lock(int(key[:15], 16))))
            connection.execute(delete(TRIES).where(TRIES.c.what == key, ~recent))
            if time.monotonic() - self._tidied > _KEPT:
                self._tidied = time.monotonic()
                connection.execute(delete(TRIES).where(TRIES.c.at < now - _KEPT))
            lately = select(func.count()).select_from(TRIES).where(TRIES.c.what == key)
            if (connection.execute(lately).scalar() or 0) + amount > limit.most:
                return False
            connection.execute(insert(TRIES), [{"what": key, "at": now}] * amount)
            return True
