"""What was done here and by whom: a log that only grows. It holds ids, no names: who is erased stays an id in it."""

from __future__ import annotations

import time
from dataclasses import dataclass

from sqlalchemy import insert, select

from app.people.tables import AUDIT
from app.session.database import Database


@dataclass(frozen=True)
class Entry:
    """One line of the log.

    Args:
        id: its number, growing.
        at: when (seconds since 1970).
        person: id of who did it; empty where nobody was known.
        deed: what.
        about: id of the person, class or session it was done to.
    """

    id: int
    at: float
    person: str
    deed: str
    about: str


class Audit:
    """The log of a database.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database

    def note(self, person: str, deed: str, about: str = "") -> None:
        """One more line; raises StorageError."""
        row = {"at": time.time(), "person": person, "deed": deed[:40], "about": about[:64]}
        with self._database.begin() as connection:
            connection.execute(insert(AUDIT), row)

    def read(self, *, person: str | None = None, after: int = 0, most: int = 1000) -> list[Entry]:
        """Lines with a number above `after`, the newest first; of one person, as doer or done to, or of all."""
        wanted = select(AUDIT).where(AUDIT.c.id > after).order_by(AUDIT.c.id.desc()).limit(most)
        if person is not None:
            wanted = wanted.where((AUDIT.c.person == person) | (AUDIT.c.about == person))
        with self._database.begin() as connection:
            return [Entry(*row) for row in connection.execute(wanted)]
