"""Classes: a trainer, a code that is written on the board, and who is in it."""

from __future__ import annotations

import secrets
import time
from dataclasses import dataclass

from sqlalchemy import delete, func, insert, select, update

from app.errors import StorageError
from app.people.limits import MEMBERS, NAME
from app.people.refusals import refused
from app.people.tables import CLASSES, PEOPLE
from app.people.tables import MEMBERS as MEMBERS_TABLE
from app.session.database import Database

#: Letters and digits that nobody takes for one another.
_LETTERS = "23456789abcdefghjkmnpqrstuvwxyz"
_CODE = 8  # of them: 40 bits


@dataclass(frozen=True)
class Class:
    """A class.

    Args:
        id: nobody guesses it.
        name: for people.
        code: lets trainees in.
        trainer: id of the person.
        created: seconds since 1970.
    """

    id: str
    name: str
    code: str
    trainer: str
    created: float


class Classes:
    """Classes of a database.

    Args:
        database: the sessions'.
    """

    def __init__(self, database: Database):
        self._database = database

    def make(self, name: str, trainer: str) -> Class:
        """A new class of this trainer (his id); raises PersonRefusedError for a name that cannot be one."""
        name = fit_name(name)
        made = Class(secrets.token_hex(16), name, _code(), trainer, time.time())
        with self._database.begin() as connection:
            connection.execute(insert(CLASSES), vars(made))
        return made

    def get(self, id: str) -> Class | None:
        """The class, where there is one."""
        with self._database.begin() as connection:
            row = connection.execute(select(CLASSES).where(CLASSES.c.id == id)).first()
        return None if row is None else Class(*row)

    def by_code(self, code: str) -> Class:
        """The class a code lets in to, however it was typed.

        Raises:
            PersonRefusedError: there is none.
        """
        typed = "".join(c for c in code.lower() if c.isalnum())
        with self._database.begin() as connection:
            row = connection.execute(select(CLASSES).where(CLASSES.c.code == typed)).first()
        if row is None:
            raise refused("no_class")
        return Class(*row)

    def find(self, text: str) -> Class:
        """The class meant by its code, id or name.

        Raises:
            PersonRefusedError: there is none, or more than one.
        """
        found = [c for c in self.list() if text in (c.id, c.code, c.name)]
        if len(found) != 1:
            names = ", ".join(f"{c.name} ({c.code})" for c in self.list()[:12])
            raise refused("which_class", text=text, classes=names or "-")
        return found[0]

    def list(self, trainer: str | None = None) -> list[Class]:
        """Classes of a trainer, or all, by name."""
        wanted = select(CLASSES).order_by(CLASSES.c.name, CLASSES.c.created)
        if trainer is not None:
            wanted = wanted.where(CLASSES.c.trainer == trainer)
        with self._database.begin() as connection:
            return [Class(*row) for row in connection.execute(wanted)]

    def change(self, id: str, *, name: str | None = None, trainer: str | None = None) -> None:
        """Another name, another trainer."""
        values = {"name": fit_name(name) if name else None, "trainer": trainer}
        with self._database.begin() as connection:
            known = {key: value for key, value in values.items() if value}
            if known:
                connection.execute(update(CLASSES).where(CLASSES.c.id == id).values(**known))

    def new_code(self, id: str) -> str:
        """Another code: the one before lets nobody in any more."""
        code = _code()
        with self._database.begin() as connection:
            connection.execute(update(CLASSES).where(CLASSES.c.id == id).values(code=code))
        return code

    def delete(self, id: str) -> None:
        """Takes a class away; its members keep their accounts and their work, and have no trainer any more."""
        with self._database.begin() as connection:
            connection.execute(delete(MEMBERS_TABLE).where(MEMBERS_TABLE.c["class"] == id))
            connection.execute(delete(CLASSES).where(CLASSES.c.id == id))

    def members(self, id: str) -> list[str]:
        """Ids of the people in a class, by name."""
        wanted = (
            select(PEOPLE.c.id)
            .join(MEMBERS_TABLE, MEMBERS_TABLE.c.person == PEOPLE.c.id)
            .where(MEMBERS_TABLE.c["class"] == id)
            .order_by(PEOPLE.c.name)
        )
        with self._database.begin() as connection:
            return list(connection.scalars(wanted))

    def of(self, person: str) -> list[Class]:
        """Classes a person is in."""
        wanted = (
            select(CLASSES)
            .join(MEMBERS_TABLE, MEMBERS_TABLE.c["class"] == CLASSES.c.id)
            .where(MEMBERS_TABLE.c.person == person)
            .order_by(CLASSES.c.name)
        )
        with self._database.begin() as connection:
            return [Class(*row) for row in connection.execute(wanted)]

    def enroll(self, id: str, person: str) -> None:
        """Puts a person into a class; who is in it already stays.

        Raises:
            PersonRefusedError: the class is full, or was deleted meanwhile.
        """
        there = (MEMBERS_TABLE.c["class"] == id) & (MEMBERS_TABLE.c.person == person)
        everyone = select(func.count()).select_from(MEMBERS_TABLE).where(MEMBERS_TABLE.c["class"] == id)
        try:
            with self._database.begin() as connection:
                if connection.execute(select(MEMBERS_TABLE).where(there)).first() is not None:
                    return
                if connection.execute(select(CLASSES.c.id).where(CLASSES.c.id == id)).first() is None:
                    raise refused("no_class")
                if (connection.execute(everyone).scalar() or 0) >= MEMBERS:
                    raise refused("full", most=MEMBERS)
                connection.execute(insert(MEMBERS_TABLE), {"class": id, "person": person})
        except StorageError:
            if id not in {c.id for c in self.of(person)}:  # not merely that he was put in twice at once
                raise

    def dismiss(self, id: str, person: str) -> None:
        """Takes a person out of a class; his account and work stay."""
        there = (MEMBERS_TABLE.c["class"] == id) & (MEMBERS_TABLE.c.person == person)
        with self._database.begin() as connection:
            connection.execute(delete(MEMBERS_TABLE).where(there))

    def trains(self, trainer: str, owner: str) -> bool:
        """True where this trainer (his id) has a class with the person whose owner string this is."""
        wanted = (
            select(CLASSES.c.id)
            .join(MEMBERS_TABLE, MEMBERS_TABLE.c["class"] == CLASSES.c.id)
            .join(PEOPLE, PEOPLE.c.id == MEMBERS_TABLE.c.person)
            .where(CLASSES.c.trainer == trainer, PEOPLE.c.owner == owner)
        )
        with self._database.begin() as connection:
            return connection.execute(wanted.limit(1)).first() is not None


def fit_name(name: str, most: int = NAME) -> str:
    """A name as it is kept: one line, single spaces; raises PersonRefusedError where nothing is left, or too much."""
    clean = " ".join("".join(c if c.isprintable() else " " for c in name).split())
    if not clean or len(clean) > most:
        raise refused("name", most=most)
    return clean


def _code() -> str:
    return "".join(secrets.choice(_LETTERS) for _ in range(_CODE))
