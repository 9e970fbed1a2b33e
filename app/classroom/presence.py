"""What everybody does now, kept by whichever process has his session open, so that a page of any process shows it."""

from __future__ import annotations

import time
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from sqlalchemy import Connection, delete, insert, select

from app.classroom.tables import PRESENCE
from app.session.database import Database

#: Seconds after which what is kept is written anew though nothing changed.
FRESH = 5.0
#: Seconds after which nobody is taken to be there: three times nothing was written; his process is gone.
GONE = 3.0 * FRESH


@dataclass(frozen=True)
class Presence:
    """What somebody does.

    Args:
        owner: owner string.
        session: the session that is open for him.
        state: as working.py names it.
        since: from when on (seconds since 1970).
        at: when that was seen last.
        exercise: key of the exercise that runs; empty where none does.
        done, points: points recorded, of so many.
    """

    owner: str
    session: str
    state: str
    since: float
    at: float
    exercise: str = ""
    done: int = 0
    points: int = 0


class Presences:
    """What everybody of a database does.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database

    def keep(self, seen: Sequence[Presence]) -> None:
        """Writes what was seen over what was kept."""
        if not seen:
            return
        rows = [vars(one) for one in seen]

        def kept(connection: Connection) -> None:
            connection.execute(delete(PRESENCE).where(PRESENCE.c.owner.in_([row["owner"] for row in rows])))
            connection.execute(insert(PRESENCE), rows)

        self._database.write(kept)

    def of(self, owners: Collection[str], now: float | None = None) -> dict[str, Presence]:
        """What these do, by owner; who was not seen for GONE seconds is away."""
        now = time.time() if now is None else now
        wanted = select(PRESENCE).where(PRESENCE.c.owner.in_(list(owners)))
        with self._database.begin() as connection:
            rows = [Presence(*row) for row in connection.execute(wanted)]
        return {
            one.owner: replace(one, state="away", since=one.at)
            if abs(now - one.at) > GONE and one.state != "away"
            else one
            for one in rows
        }
