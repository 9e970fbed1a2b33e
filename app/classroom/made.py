"""Exercises made here, kept: a file each that never changes; another content is another exercise."""

from __future__ import annotations

import time
from dataclasses import dataclass

from sqlalchemy import delete, insert, select, update

from app.classroom.tables import MADE
from app.errors import FileFormatError, InputError, UnknownNameError
from app.session.database import Database
from app.training.exercise import Exercise, exercise, made_exercise

#: Exercises of one trainer that are shown in his list.
MOST = 200
#: Bytes of a file: the largest shipped one has 1,400.
LARGEST = 20_000


@dataclass(frozen=True)
class Kept:
    """An exercise somebody made.

    Args:
        key: its key.
        created: seconds since 1970.
        lesson: its file.
    """

    key: str
    created: float
    lesson: str


class Made:
    """Exercises made here, of a database.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database

    def keep(self, author: str, lesson: str) -> Exercise:
        """Keeps a file; the exercise it is.

        Raises:
            FileFormatError: something in it cannot be; says where.
            InputError: too large, or its author has too many.
        """
        if len(lesson.encode()) > LARGEST:
            raise InputError(f"more than {LARGEST} bytes", column="exercise", expected="a smaller file")
        made = made_exercise(lesson)
        if len(self.of(author)) >= MOST:
            raise InputError(f"{MOST} exercises already", column="exercise", expected="put some away")
        row = {
            "key": made.key,
            "author": author,
            "created": time.time(),
            "hidden": False,
            "lesson": lesson,
        }
        mine = (MADE.c.key == made.key) & (MADE.c.author == author)
        with self._database.begin() as connection:
            connection.execute(delete(MADE).where(mine))
            connection.execute(insert(MADE), row)
        return made

    def of(self, author: str) -> list[Kept]:
        """What somebody made and did not put away, the newest first."""
        wanted = (
            select(MADE.c.key, MADE.c.created, MADE.c.lesson)
            .where(MADE.c.author == author, MADE.c.hidden.is_(False))
            .order_by(MADE.c.created.desc())
        )
        with self._database.begin() as connection:
            return [Kept(*row) for row in connection.execute(wanted)]

    def put_away(self, author: str, key: str) -> None:
        """Out of its author's list; classes that have it as a lesson keep it."""
        with self._database.begin() as connection:
            connection.execute(
                update(MADE).where(MADE.c.key == key, MADE.c.author == author).values(hidden=True)
            )

    def text(self, key: str) -> str:
        """The file of an exercise made here; raises UnknownNameError."""
        with self._database.begin() as connection:
            lesson = connection.execute(select(MADE.c.lesson).where(MADE.c.key == key)).scalar()
        if lesson is None:
            raise UnknownNameError(key[:80], available=["(exercises made here)"], what="exercise")
        return lesson

    def exercise(self, key: str) -> Exercise:
        """An exercise by its key, shipped or made here.

        Raises:
            UnknownNameError: there is none.
            FileFormatError: its file has a mistake: it was changed by hand, or this program reads it otherwise.
        """
        try:
            return exercise(key)
        except UnknownNameError:
            found = made_exercise(self.text(key))
        if found.key != key:
            raise FileFormatError("not what it was made as", file=f"{key}.toml")
        return found
