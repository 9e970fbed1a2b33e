"""Lessons of a class: which exercise, in which order, until when, with which helps."""

from __future__ import annotations

import secrets
from collections.abc import Iterable
from dataclasses import dataclass

from sqlalchemy import delete, func, insert, select, update

from app.classroom.tables import CLASS_HELPS, LESSONS
from app.errors import InputError
from app.session.database import Database

#: Helps that a class or a lesson can take away, as an exercise's `allowed` names them.
HELPS = ("distance", "closeup", "next_touch", "handle", "touch", "light")
#: Lessons of one class: a page that is still read.
MOST = 60


@dataclass(frozen=True)
class Assignment:
    """One lesson of a class.

    Args:
        id: nobody guesses it.
        at: the class.
        exercise: key of the exercise.
        place: order, from 1.
        due: seconds since 1970; 0 is never.
        without: helps that are not allowed here.
    """

    id: str
    at: str
    exercise: str
    place: int
    due: float
    without: tuple[str, ...]


class Assignments:
    """Lessons of a database.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database

    def of(self, at: str) -> list[Assignment]:
        """Lessons of a class in their order."""
        wanted = select(LESSONS).where(LESSONS.c["class"] == at).order_by(LESSONS.c.place, LESSONS.c.id)
        with self._database.begin() as connection:
            rows = connection.execute(wanted).all()
        return [
            Assignment(id, at, exercise, place, due, tuple(without.split()))
            for id, at, exercise, place, due, without in rows
        ]

    def give(self, at: str, exercise: str, due: float = 0.0, without: Iterable[str] = ()) -> str:
        """One more lesson, the last of its class; its id.

        Raises:
            InputError: the class has it already, or has too many.
        """
        there = self.of(at)
        if exercise in {lesson.exercise for lesson in there}:
            raise InputError("the class has this exercise already", column="exercise")
        if len(there) >= MOST:
            raise InputError(f"the class has {MOST} lessons already", column="exercise", expected="fewer")
        row = {
            "id": secrets.token_hex(16),
            "class": at,
            "exercise": exercise,
            "place": 1 + max((lesson.place for lesson in there), default=0),
            "due": due,
            "without": _words(without),
        }
        with self._database.begin() as connection:
            connection.execute(insert(LESSONS), row)
        return str(row["id"])

    def change(
        self, at: str, id: str, *, due: float | None = None, without: Iterable[str] | None = None
    ) -> None:
        """Another due time, other helps; a lesson that is not there, or of another class, is left alone."""
        values: dict[str, object] = {} if due is None else {"due": due}
        if without is not None:
            values["without"] = _words(without)
        if values:
            with self._database.begin() as connection:
                connection.execute(update(LESSONS).where(*_one(at, id)).values(**values))

    def move(self, at: str, id: str, by: int) -> None:
        """A lesson goes so many places down; up where `by` is below zero. The places are counted anew."""
        there = self.of(at)
        index = next((k for k, lesson in enumerate(there) if lesson.id == id), None)
        if index is None:
            return
        moved = there.pop(index)
        there.insert(min(max(index + by, 0), len(there)), moved)
        with self._database.begin() as connection:
            for place, lesson in enumerate(there, 1):
                connection.execute(update(LESSONS).where(*_one(at, lesson.id)).values(place=place))

    def take_away(self, at: str, id: str) -> None:
        """The class does not have this lesson any more; what was reached in it stays."""
        with self._database.begin() as connection:
            connection.execute(delete(LESSONS).where(*_one(at, id)))

    def without(self, at: str) -> tuple[str, ...]:
        """Helps that a class does not have in any lesson."""
        wanted = select(CLASS_HELPS.c.without).where(CLASS_HELPS.c["class"] == at)
        with self._database.begin() as connection:
            return tuple((connection.execute(wanted).scalar() or "").split())

    def forbid(self, at: str, without: Iterable[str]) -> None:
        """The class has these helps in no lesson, and all others where exercise and lesson allow them."""
        with self._database.begin() as connection:
            connection.execute(delete(CLASS_HELPS).where(CLASS_HELPS.c["class"] == at))
            connection.execute(insert(CLASS_HELPS), {"class": at, "without": _words(without)})

    def forget(self, at: str) -> None:
        """A class is deleted: its lessons go, too."""
        with self._database.begin() as connection:
            for table in (LESSONS, CLASS_HELPS):
                connection.execute(delete(table).where(table.c["class"] == at))

    def count(self, exercise: str) -> int:
        """How many classes have this exercise."""
        wanted = select(func.count()).select_from(LESSONS).where(LESSONS.c.exercise == exercise)
        with self._database.begin() as connection:
            return int(connection.execute(wanted).scalar() or 0)


def _one(at: str, id: str):
    return LESSONS.c.id == id, LESSONS.c["class"] == at


def _words(helps: Iterable[str]) -> str:
    given = set(helps)
    return " ".join(name for name in HELPS if name in given)
