"""A trainer's words to a trainee: kept until he has put them away, with the times he got them."""

from __future__ import annotations

import time
from collections.abc import Collection
from dataclasses import dataclass

from sqlalchemy import func, insert, select, update

from app.classroom.tables import HINTS
from app.errors import InputError
from app.session.database import Database

#: Characters of a hint: what stands in a message line without hiding the cell.
LONGEST = 300
#: Hints a trainee can have before him at once: what is more waits for those to be put away.
AT_ONCE = 20


@dataclass(frozen=True)
class Hint:
    """One hint. Times in seconds since 1970; 0 where it did not happen yet.

    Args:
        id: its number.
        trainer: id of who sent it.
        owner: owner string of whom it is for.
        text: what it says.
        sent, shown, put_away: when it was sent, when his page showed it, when he put it away.
    """

    id: int
    trainer: str
    owner: str
    text: str
    sent: float
    shown: float
    put_away: float


class Hints:
    """Hints of a database.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database

    def send(self, trainer: str, owner: str, text: str) -> None:
        """One hint.

        Raises:
            InputError: nothing in it, too long, or he has too many before him.
        """
        text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
        if not text or len(text) > LONGEST:
            raise InputError(
                f"{len(text)} characters" if text else "nothing in it",
                column="hint",
                expected=f"1 to {LONGEST} characters",
            )
        if len(self.waiting([owner])) >= AT_ONCE:
            raise InputError(f"{AT_ONCE} hints wait for him already", column="hint")
        row = {
            "trainer": trainer,
            "owner": owner,
            "text": text,
            "sent": time.time(),
            "shown": 0.0,
            "put_away": 0.0,
        }
        with self._database.begin() as connection:
            connection.execute(insert(HINTS), row)

    def waiting(self, owners: Collection[str]) -> list[Hint]:
        """Hints that were not put away yet, the oldest first."""
        return self._read(HINTS.c.owner.in_(list(owners)), HINTS.c.put_away == 0.0)

    def of(self, owner: str, most: int = 50) -> list[Hint]:
        """The last hints somebody was sent, the newest first."""
        return self._read(HINTS.c.owner == owner)[::-1][:most]

    def latest(self, owners: Collection[str]) -> dict[str, Hint]:
        """The last hint of each who was sent one, by owner."""
        newest = select(func.max(HINTS.c.id)).where(HINTS.c.owner.in_(list(owners))).group_by(HINTS.c.owner)
        return {hint.owner: hint for hint in self._read(HINTS.c.id.in_(newest))}

    def shown(self, id: int, owner: str) -> None:
        """His page shows it; the first time counts."""
        self._mark(id, owner, "shown")

    def put_away(self, id: int, owner: str) -> None:
        """He has read it."""
        self._mark(id, owner, "shown")
        self._mark(id, owner, "put_away")

    def _mark(self, id: int, owner: str, column: str) -> None:
        one = (HINTS.c.id == id, HINTS.c.owner == owner, HINTS.c[column] == 0.0)
        with self._database.begin() as connection:
            connection.execute(update(HINTS).where(*one).values({column: time.time()}))

    def _read(self, *where) -> list[Hint]:
        with self._database.begin() as connection:
            return [
                Hint(*row) for row in connection.execute(select(HINTS).where(*where).order_by(HINTS.c.id))
            ]
