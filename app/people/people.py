"""Accounts: who is known here, how he proves it, what he may do."""

from __future__ import annotations

import secrets
import time
from typing import Any

from sqlalchemy import insert, select, update
from sqlalchemy.sql.elements import ColumnElement

from app.errors import StorageError
from app.people.audit import Audit
from app.people.classes import Classes, fit_name
from app.people.doors import ADMINISTRATOR, HIS_TRAINER, SELF, STRANGER, allowed
from app.people.limits import FAILED, LOCKED, LOGIN_NAME, TRIES, TRIES_OF_ADDRESS
from app.people.logins import Logins
from app.people.person import Person, Role, fit_login, fit_role, folded, owner_of_person
from app.people.refusals import refused
from app.people.secret import fit_password, fit_pin, hashed, matches, outdated
from app.people.tables import PEOPLE
from app.people.tries import Tries
from app.session.database import Database

_PERSON = [PEOPLE.c[name] for name in Person.__dataclass_fields__]


class People:
    """The accounts of a database.

    Args:
        database: the sessions' (`Store.database`).

    Attributes:
        database: as given.
        classes, logins, audit, tries: of it.
    """

    def __init__(self, database: Database):
        self.database = database
        self.classes, self.logins = Classes(database), Logins(database)
        self.audit, self.tries = Audit(database), Tries(database)

    def any(self) -> bool:
        """True where there is an account: from then on nobody comes in without one."""
        return bool(self._all(most=1))

    def list(self) -> list[Person]:
        """Everybody, by log-in name."""
        return self._all()

    def get(self, id: str) -> Person | None:
        """The person with this id."""
        return next(iter(self._all(PEOPLE.c.id == id)), None)

    def of(self, owner: str) -> Person | None:
        """The person whose sessions hang on this owner string."""
        return next(iter(self._all(PEOPLE.c.owner == owner)), None)

    def vouched(self, outside: str) -> Person | None:
        """The person that an issuer vouches for by this subject."""
        return next(iter(self._all(PEOPLE.c.outside == outside)), None)

    def find(self, login: str) -> Person:
        """The person who logs in so; raises PersonRefusedError."""
        found = self._all(PEOPLE.c.login == folded(login))
        if not found:
            raise refused("nobody", login=login)
        return found[0]

    def add(
        self, login: str, name: str, role: Role, secret: str, *, by: str = "", outside: str | None = None
    ) -> Person:
        """A new account.

        Args:
            login: what he will type; kept in small letters.
            name: what others see.
            role: trainee, trainer or administrator.
            secret: his password; empty only where `outside` vouches for him.
            by: id of who adds him.
            outside: issuer and subject, where OpenID Connect vouches for him.

        Raises:
            PersonRefusedError: the log-in name is taken, or something cannot be what it should.
        """
        kept = hashed(fit_password(secret)) if secret or outside is None else ""
        return self._add(fit_login(login), name, role, kept, by, outside)

    def authenticate(self, login: str, secret: str, address: str) -> Person:
        """Whoever types this log-in name and this password or PIN.

        Args:
            login, secret: as typed.
            address: where from: tries are counted by name and address.

        Raises:
            PersonRefusedError: not these two (it does not say which), too many tries, or locked.
        """
        login = folded(login)[:LOGIN_NAME]
        enough = self.tries.count(TRIES_OF_ADDRESS, "address", address)
        if not enough or not self.tries.count(TRIES, "login", login, address):
            raise refused("slowly", most=TRIES.most)
        with self.database.begin() as connection:
            row = connection.execute(select(PEOPLE).where(PEOPLE.c.login == login)).first()
        now = time.time()
        if row is not None and now < row.locked_until <= now + LOCKED:
            raise refused("locked", minutes=int((row.locked_until - now) // 60) + 1)
        right = matches(row.secret if row is not None else "", secret)
        if row is None or not right or row.disabled:
            if row is not None:
                self._missed(row)
            self.audit.note("" if row is None else row.id, "log_in_refused")
            raise refused("wrong")
        values: dict[str, Any] = {"failed": 0, "locked_until": 0.0}
        if outdated(row.secret):
            values["secret"] = hashed(secret)
        self._set(row.id, **values)
        self.audit.note(row.id, "log_in")
        return self._known(row.id)

    def join(self, code: str, name: str, pin: str, address: str) -> Person:
        """Comes into a class by its code: the first time with a PIN of one's own, later with the same.

        Args:
            code: of the class.
            name: one's own; in this class nobody else has it.
            pin: six digits or more.
            address: where from.

        Raises:
            PersonRefusedError: no such class, a PIN that cannot be one or is another's, too many tries.
        """
        name = fit_name(name)
        if not self.tries.count(TRIES_OF_ADDRESS, "join", address):
            raise refused("slowly", most=TRIES_OF_ADDRESS.most)
        at = self.classes.by_code(code)
        login = folded(f"{name}@{at.id[:8]}")
        if self._all(PEOPLE.c.login == login):
            person = self.authenticate(login, pin, address)
        else:
            person = self._add(login, name, "trainee", hashed(fit_pin(pin)), "", None)
            self.audit.note(person.id, "log_in")
        self.classes.enroll(at.id, person.id)
        return person

    def enroll(self, code: str, person: Person, address: str) -> None:
        """Puts somebody who is logged in into one more class; raises PersonRefusedError."""
        if not self.tries.count(TRIES_OF_ADDRESS, "join", address):
            raise refused("slowly", most=TRIES_OF_ADDRESS.most)
        self.classes.enroll(self.classes.by_code(code).id, person.id)

    def change(
        self,
        id: str,
        *,
        by: str = "",
        name: str | None = None,
        role: Role | None = None,
        secret: str | None = None,
        pin: str | None = None,
        disabled: bool | None = None,
    ) -> Person:
        """Changes what is given; who gets another secret or role, or is shut out, is logged out everywhere.

        Raises:
            PersonRefusedError: nobody has this id, what is given cannot be, no administrator would be left, or a
                trainer who has classes would be none any more.
        """
        person = self._known(id)
        lower = (role or person.role) != person.role or disabled
        if lower and person.role == "administrator" and not self._another_administrator(id):
            raise refused("last_administrator")
        if role == "trainee" and self.classes.list(trainer=id):
            raise refused("has_classes")
        values: dict[str, Any] = {"name": fit_name(name)} if name is not None else {}
        if role is not None:
            values["role"] = fit_role(role)
        if disabled is not None:
            values["disabled"] = disabled
        if secret is not None or pin is not None:
            kept = hashed(fit_password(secret) if secret is not None else fit_pin(pin or ""))
            values |= {"secret": kept, "failed": 0, "locked_until": 0.0}
        if values:
            self._set(id, **values)
            for deed in values.keys() - {"failed", "locked_until"}:
                self.audit.note(by, f"change_{deed}", id)
        if values.keys() & {"role", "secret", "disabled"}:
            self.logins.end_all(id)
        return self._known(id)

    def may(self, person: Person | None, deed: str, owner: str | None = None) -> bool:
        """True where the table of doors lets this person do that.

        Args:
            person: None is somebody who is not logged in.
            deed: a key of `doors.DOORS`; KeyError for another.
            owner: owner string of whom the session, record or class belongs to; None where the deed has none.
        """
        return any(allowed(deed, standing) for standing in self.standings(person, owner))

    def standings(self, person: Person | None, owner: str | None = None) -> set[str]:
        """How somebody stands to what belongs to this owner: columns of the table of doors."""
        if person is None or person.disabled:
            return {STRANGER}
        found = {ADMINISTRATOR} if person.role == "administrator" else set()
        if owner is not None and owner == person.owner:
            return found | {SELF}
        if owner is not None and person.role != "trainee" and self.classes.trains(person.id, owner):
            return found | {HIS_TRAINER}
        return found | {person.role}

    def must_be_erasable(self, person: Person) -> None:
        """Raises PersonRefusedError where no administrator would be left, or classes would have no trainer."""
        if person.role == "administrator" and not self._another_administrator(person.id):
            raise refused("last_administrator")
        if self.classes.list(trainer=person.id):
            raise refused("has_classes")

    def has_secret(self, id: str) -> bool:
        """True where he comes in by a password or PIN, not only by somebody who vouches for him."""
        with self.database.begin() as connection:
            return bool(connection.execute(select(PEOPLE.c.secret).where(PEOPLE.c.id == id)).scalar())

    # What is kept ------------------------------------------------------------------------------------------

    def _all(self, *where: ColumnElement[bool], most: int | None = None) -> list[Person]:
        wanted = select(*_PERSON).where(*where).order_by(PEOPLE.c.login).limit(most)
        with self.database.begin() as connection:
            return [Person(*row) for row in connection.execute(wanted)]

    def _known(self, id: str) -> Person:
        person = self.get(id)
        if person is None:
            raise refused("nobody", login=id)
        return person

    def _add(self, login: str, name: str, role: Role, kept: str, by: str, outside: str | None) -> Person:
        id = secrets.token_hex(16)
        row = {
            "id": id,
            "owner": owner_of_person(id),
            "login": login,
            "name": fit_name(name),
            "role": fit_role(role),
            "secret": kept,
            "outside": outside,
            "failed": 0,
            "locked_until": 0.0,
            "created": time.time(),
            "disabled": False,
        }
        if self._all(PEOPLE.c.login == login):
            raise refused("taken", login=login)
        try:
            with self.database.begin() as connection:
                connection.execute(insert(PEOPLE), row)
        except StorageError:
            if self._all(PEOPLE.c.login == login):  # two at once
                raise refused("taken", login=login) from None
            raise
        self.audit.note(by or id, "add", id)
        return self._known(id)

    def _set(self, id: str, **values: Any) -> None:
        with self.database.begin() as connection:
            connection.execute(update(PEOPLE).where(PEOPLE.c.id == id).values(**values))

    def _missed(self, row: Any) -> None:
        """Counts a wrong try in the database itself, so that tries at the same moment all count."""
        with self.database.begin() as connection:
            one = update(PEOPLE).where(PEOPLE.c.id == row.id)
            connection.execute(one.values(failed=PEOPLE.c.failed + 1))
            locked = {"failed": 0, "locked_until": time.time() + LOCKED}
            now = connection.execute(one.where(PEOPLE.c.failed >= FAILED).values(**locked)).rowcount
        if now:
            self.audit.note(row.id, "locked")

    def _another_administrator(self, id: str) -> bool:
        there = (PEOPLE.c.role == "administrator", PEOPLE.c.disabled.is_(False), PEOPLE.c.id != id)
        return bool(self._all(*there, most=1))
