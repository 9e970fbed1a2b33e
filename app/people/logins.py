"""Browsers that are logged in. A browser holds a secret; here stands its hash, and until when it counts."""

from __future__ import annotations

import hashlib
import secrets
import time

from sqlalchemy import delete, insert, select, update

from app.people.limits import IDLE, LOGIN, TOUCH
from app.people.tables import LOGINS, PEOPLE
from app.session.database import Database


class Logins:
    """Log-ins of a database.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database

    def begin(self, person: str) -> str:
        """A new secret for a browser of this person: 256 bits; it was never anywhere before."""
        secret, now = secrets.token_urlsafe(32), time.time()
        row = {"hash": _hash(secret), "person": person, "created": now, "last": now, "expires": now + LOGIN}
        with self._database.begin() as connection:
            # Those that ended stay for as long again: who comes back with one is told so.
            connection.execute(delete(LOGINS).where(~LOGINS.c.expires.between(now - LOGIN, now + LOGIN)))
            connection.execute(insert(LOGINS), row)
        return secret

    def person(self, secret: str, *, alive: bool = True) -> str | None:
        """Id of whom a browser's secret belongs to; None where it ended, or he is shut out.

        Args:
            secret: the browser's.
            alive: a person asked, not a clock: the log-in's rest begins anew.
        """
        now, key = time.time(), _hash(secret)
        found = (
            select(LOGINS.c.person, LOGINS.c.last)
            .join(PEOPLE, PEOPLE.c.id == LOGINS.c.person)
            .where(LOGINS.c.hash == key, _counts(now), PEOPLE.c.disabled.is_(False))
        )
        with self._database.begin() as connection:
            row = connection.execute(found).first()
            if row is None:
                return None
            if alive and abs(now - row.last) > TOUCH:
                connection.execute(update(LOGINS).where(LOGINS.c.hash == key).values(last=now))
            return row.person

    def ran_out(self, secret: str) -> str | None:
        """Id of whom a browser's secret belonged to until its time ran out, said once; None for any other."""
        now, mine = time.time(), LOGINS.c.hash == _hash(secret)
        with self._database.begin() as connection:
            person = connection.execute(select(LOGINS.c.person).where(mine, ~_counts(now))).scalar()
            if person is None:
                return None
            return person if connection.execute(delete(LOGINS).where(mine)).rowcount else None

    def end(self, secret: str) -> None:
        """Logged out; a secret that is not known is no error."""
        with self._database.begin() as connection:
            connection.execute(delete(LOGINS).where(LOGINS.c.hash == _hash(secret)))

    def end_all(self, person: str) -> None:
        """Logs a person out everywhere."""
        with self._database.begin() as connection:
            connection.execute(delete(LOGINS).where(LOGINS.c.person == person))


def _hash(secret: str) -> str:
    return hashlib.sha256(secret.encode("utf-8", "surrogatepass")).hexdigest()


def _counts(now: float):
    """Log-ins that count: neither at their end nor at rest too long. Where the clock was set back, the end that was
    written is never further away than a log-in is long."""
    return (LOGINS.c.expires > now) & (LOGINS.c.expires <= now + LOGIN) & (LOGINS.c.last > now - IDLE)
