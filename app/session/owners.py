"""Whose a session is, what it is called, and which of his somebody had open last.

A person is a secret that only his browser holds; here stands its hash, so that nobody who reads the database or an
exported session becomes that person.
"""

from __future__ import annotations

import hashlib
import secrets
import time

from sqlalchemy import Column, Connection, Float, String, Table, delete, func, insert, select, update

from app.session.database import ACTIONS, METADATA, SESSIONS, Database

OWNED = Table(
    "owned",
    METADATA,
    Column("session", String(32), primary_key=True),
    Column("owner", String(64), nullable=False, index=True),
    Column("title", String(120), nullable=False),
    Column("opened", Float, nullable=False),
)
LONGEST_TITLE = 120


def new_secret() -> str:
    """What makes somebody a person: 256 bits, for a cookie."""
    return secrets.token_urlsafe(32)


def owner_of(secret: str) -> str:
    """The person a secret makes."""
    return hashlib.sha256(secret.encode()).hexdigest()


class Owners:
    """Who owns which sessions of a database.

    Args:
        database: the store's.
    """

    def __init__(self, database: Database):
        self._database = database

    def give(self, session: str, owner: str, title: str = "") -> None:
        """The session belongs to this person from now on."""
        row = {"session": session, "owner": owner, "title": title[:LONGEST_TITLE], "opened": time.time()}

        def given(connection: Connection) -> None:
            connection.execute(delete(OWNED).where(OWNED.c.session == session))
            connection.execute(insert(OWNED), row)

        self._database.write(given)

    def opened(self, session: str) -> None:
        """Its owner has it open now."""
        now = update(OWNED).where(OWNED.c.session == session).values(opened=time.time())
        self._database.write(lambda connection: connection.execute(now))

    def rename(self, session: str, title: str) -> None:
        """Another name for people."""
        with self._database.begin() as connection:
            connection.execute(
                update(OWNED).where(OWNED.c.session == session).values(title=title.strip()[:LONGEST_TITLE])
            )

    def forget(self, session: str) -> None:
        """The session is no more."""
        with self._database.begin() as connection:
            connection.execute(delete(OWNED).where(OWNED.c.session == session))

    def latest(self, owner: str) -> str | None:
        """The session this person had open last."""
        newest = (
            select(OWNED.c.session).where(OWNED.c.owner == owner).order_by(OWNED.c.opened.desc()).limit(1)
        )
        with self._database.begin() as connection:
            return connection.execute(newest).scalar()

    def titles(self, owner: str) -> dict[str, str]:
        """Session -> its name for people, of all that belong to this person."""
        mine = select(OWNED.c.session, OWNED.c.title).where(OWNED.c.owner == owner)
        with self._database.begin() as connection:
            return {row.session: row.title for row in connection.execute(mine)}

    def used(self, owner: str) -> tuple[int, int]:
        """How many sessions a person keeps, and how many characters their actions have."""
        size = (
            select(func.coalesce(func.sum(func.length(ACTIONS.c.action)), 0))
            .join(OWNED, OWNED.c.session == ACTIONS.c.session)
            .where(OWNED.c.owner == owner)
        )
        count = select(func.count()).select_from(OWNED).where(OWNED.c.owner == owner)
        with self._database.begin() as connection:
            return int(connection.execute(count).scalar_one()), int(connection.execute(size).scalar_one())

    def nobodys(self) -> set[str]:
        """Sessions that belong to nobody: what earlier versions kept."""
        left = SESSIONS.outerjoin(OWNED, OWNED.c.session == SESSIONS.c.name)
        with self._database.begin() as connection:
            found = select(SESSIONS.c.name).select_from(left).where(OWNED.c.session.is_(None))
            return set(connection.scalars(found))
