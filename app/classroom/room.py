"""A class at work, put together: its lessons with their exercises, how everybody stands, what everybody does."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

from sqlalchemy import select

from app.classroom.assignments import Assignment, Assignments
from app.classroom.grades import Row
from app.classroom.hints import Hints
from app.classroom.losses import Losses, losses
from app.classroom.made import Made
from app.classroom.presence import Presence, Presences
from app.classroom.progress import Lesson, Standing, next_lesson, standings
from app.errors import TeachframeError
from app.people import People, Person
from app.people.classes import Class
from app.people.tables import MEMBERS, PEOPLE
from app.session.database import Database
from app.training.records import Records


@dataclass(frozen=True)
class Seat:
    """One trainee of a class.

    Args:
        person: who.
        standings: lesson id -> how he stands.
        now: what he does; None where he was never seen.
        next: his next lesson.
    """

    person: Person
    standings: dict[str, Standing]
    now: Presence | None
    next: Lesson | None


class Room:
    """Classes at work, of a database.

    Args:
        database: the sessions' (`Store.database`).

    Attributes:
        people, assignments, made, hints, presences, records: of the same database.
    """

    def __init__(self, database: Database):
        self._database = database
        self.people, self.records = People(database), Records(database)
        self.assignments, self.made = Assignments(database), Made(database)
        self.hints, self.presences = Hints(database), Presences(database)

    def lessons(self, at: str) -> list[Lesson]:
        """Lessons of a class in their order; one whose exercise has a mistake says so."""
        without = self.assignments.without(at)
        return [self._lesson(one, without) for one in self.assignments.of(at)]

    def lessons_of(self, person: str) -> list[tuple[Class, list[Lesson]]]:
        """What somebody (his id) has to do, class by class."""
        return [(at, self.lessons(at.id)) for at in self.people.classes.of(person)]

    def delete(self, at: str, by: str) -> None:
        """A class and its lessons go; those that run go on, each carries all it needs. Scores and sessions stay.

        Args:
            at: the class.
            by: id of who does it.
        """
        self.people.audit.note(by, "class_delete", at)
        self.people.classes.delete(at)
        self.assignments.forget(at)

    def seats(self, at: str) -> list[Seat]:
        """Everybody of a class, by name, without its trainer."""
        lessons, now = self.lessons(at), time.time()
        persons = self.members(at)
        owners = [person.owner for person in persons]
        cards = self.records.histories([person.id for person in persons])
        seen = self.presences.of(owners, now)
        seats = []
        for person in persons:
            stand = standings(lessons, cards.get(person.id, []), now)
            seats.append(Seat(person, stand, seen.get(person.owner), next_lesson(lessons, stand)))
        return seats

    def members(self, at: str) -> list[Person]:
        """Who is in a class, by name."""
        wanted = (
            select(*(PEOPLE.c[name] for name in Person.__dataclass_fields__))
            .join(MEMBERS, MEMBERS.c.person == PEOPLE.c.id)
            .where(MEMBERS.c["class"] == at)
            .order_by(PEOPLE.c.name)
        )
        with self._database.begin() as connection:
            return [Person(*row) for row in connection.execute(wanted)]

    def enrolled(self) -> frozenset[str]:
        """Owner strings of everybody who is in a class."""
        wanted = select(PEOPLE.c.owner).join(MEMBERS, MEMBERS.c.person == PEOPLE.c.id).distinct()
        with self._database.begin() as connection:
            return frozenset(connection.scalars(wanted))

    def standings(self, person: Person, lessons: Sequence[Lesson]) -> dict[str, Standing]:
        """How somebody stands in these lessons, by lesson id."""
        return standings(lessons, self.records.history(person.id), time.time())

    def losses(self, at: str, lesson: Lesson) -> Losses:
        """Where a class loses points in a lesson."""
        return losses(self.records.histories([person.id for person in self.members(at)], lesson.key))

    def rows(self, at: str) -> list[Row]:
        """A class as its tables have it."""
        return [Row(seat.person.name, seat.person.login, seat.standings) for seat in self.seats(at)]

    def _lesson(self, one: Assignment, without: tuple[str, ...]) -> Lesson:
        every = tuple(dict.fromkeys((*without, *one.without)))
        try:
            exercise = self.made.exercise(one.exercise)
        except TeachframeError as error:
            return Lesson(one.id, one.exercise, None, str(error), one.due, every, one.without)
        return Lesson(one.id, one.exercise, exercise, "", one.due, every, one.without)
