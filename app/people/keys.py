"""Keys that every process of one server shares: made once, kept in its database."""

from __future__ import annotations

import secrets

from sqlalchemy import insert, select

from app.errors import StorageError
from app.people.tables import KEYS
from app.session.database import Database


def server_key(database: Database, purpose: str = "cookies") -> bytes:
    """32 random bytes, the same at every call and in every process."""
    wanted = select(KEYS.c.key).where(KEYS.c.purpose == purpose)
    with database.begin() as connection:
        kept = connection.execute(wanted).scalar()
    if kept is None:
        made = {"purpose": purpose, "key": secrets.token_hex(32)}
        try:
            with database.begin() as connection:
                connection.execute(insert(KEYS), made)
        except StorageError:  # another process made it in the same moment
            pass
        with database.begin() as connection:
            kept = connection.execute(wanted).scalar_one()
    return bytes.fromhex(kept)
