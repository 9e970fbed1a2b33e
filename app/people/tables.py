"""Tables of people, beside those of sessions.

The audit log only grows, and the database itself sees to it: changing or taking away a row is refused there, whoever
asks (session/migrations).
"""

from __future__ import annotations

from sqlalchemy import Boolean, Column, Float, Integer, String, Table, UniqueConstraint

from app.session.database import METADATA

PEOPLE = Table(
    "people",
    METADATA,
    Column("id", String(32), primary_key=True),  # 128 random bits
    Column("owner", String(64), nullable=False, unique=True),  # what his sessions and scores hang on
    Column("login", String(120), nullable=False, unique=True),
    Column("name", String(80), nullable=False),
    Column("role", String(20), nullable=False),  # trainee, trainer, administrator
    Column("secret", String(200), nullable=False),  # argon2's own text; empty where somebody else vouches
    Column("outside", String(255), unique=True),  # issuer and subject of whom OpenID Connect vouches for
    Column("failed", Integer, nullable=False),  # tries in a row
    Column("locked_until", Float, nullable=False),  # seconds since 1970; 0 is not locked
    Column("created", Float, nullable=False),
    Column("disabled", Boolean, nullable=False),
)
LOGINS = Table(
    "logins",
    METADATA,
    Column("hash", String(64), primary_key=True),  # SHA-256 of the browser's secret
    Column("person", String(32), nullable=False, index=True),
    Column("created", Float, nullable=False),
    Column("last", Float, nullable=False),
    Column("expires", Float, nullable=False),
)
CLASSES = Table(
    "classes",
    METADATA,
    Column("id", String(32), primary_key=True),
    Column("name", String(80), nullable=False),
    Column("code", String(16), nullable=False, unique=True),
    Column("trainer", String(32), nullable=False, index=True),
    Column("created", Float, nullable=False),
)
MEMBERS = Table(
    "members",
    METADATA,
    Column("class", String(32), primary_key=True),
    Column("person", String(32), primary_key=True, index=True),
)
AUDIT = Table(
    "audit",
    METADATA,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("at", Float, nullable=False),
    Column("person", String(32), nullable=False, index=True),  # id of who did it; empty: nobody known
    Column("deed", String(40), nullable=False),
    Column("about", String(64), nullable=False),  # id of the person, class or session it was done to
)
TRIES = Table(
    "tries",
    METADATA,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("what", String(64), nullable=False, index=True),  # a hash: nobody's name or address
    Column("at", Float, nullable=False),
)
KEYS = Table(
    "keys",
    METADATA,
    Column("purpose", String(40), primary_key=True),
    Column("key", String(64), nullable=False),
    UniqueConstraint("key"),
)
