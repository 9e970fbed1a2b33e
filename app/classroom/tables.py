"""Tables of a class at work, beside those of sessions and people."""

from __future__ import annotations

from sqlalchemy import Boolean, Column, Float, Integer, String, Table, Text

from app.session.database import METADATA

LESSONS = Table(
    "lessons",
    METADATA,
    Column("id", String(32), primary_key=True),
    Column("class", String(32), nullable=False, index=True),
    Column("exercise", String(80), nullable=False),
    Column("place", Integer, nullable=False),  # order in the class
    Column("due", Float, nullable=False),  # seconds since 1970; 0 is never
    Column(
        "without", String(120), nullable=False
    ),  # names of helps that are not allowed, with spaces between
)
CLASS_HELPS = Table(
    "class_helps",
    METADATA,
    Column("class", String(32), primary_key=True),
    Column("without", String(120), nullable=False),
)
MADE = Table(
    "made_exercises",
    METADATA,
    Column("key", String(80), primary_key=True),
    Column("author", String(32), primary_key=True),  # id of the person
    Column("created", Float, nullable=False),
    Column("hidden", Boolean, nullable=False),  # its author put it away; lessons that have it go on
    Column("lesson", Text, nullable=False),  # the file
)
HINTS = Table(
    "hints",
    METADATA,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("trainer", String(32), nullable=False),  # id of the person
    Column("owner", String(64), nullable=False, index=True),  # whom it is for
    Column("text", Text, nullable=False),
    Column("sent", Float, nullable=False),
    Column("shown", Float, nullable=False),  # when his page showed it; 0: not yet
    Column("put_away", Float, nullable=False),  # when he put it away; 0: not yet
)
PRESENCE = Table(
    "presence",
    METADATA,
    Column("owner", String(64), primary_key=True),
    Column("session", String(32), nullable=False),
    Column("state", String(16), nullable=False),  # as working.py names them
    Column("since", Float, nullable=False),
    Column("at", Float, nullable=False),  # when it was seen last
    Column("exercise", String(80), nullable=False),
    Column("done", Integer, nullable=False),  # points recorded
    Column("points", Integer, nullable=False),  # of so many
)
