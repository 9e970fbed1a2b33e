"""Who is asking: a browser on a server without accounts, a person where there are some; and what he may.

A browser's cookie is a secret of 256 bits. With accounts it is signed, too, so that a forged one costs no look into
the database, and it was given when its person logged in.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass

from starlette.requests import HTTPConnection
from starlette.responses import Response

from app.people import People, Person
from app.people.doors import allowed
from app.people.keys import server_key
from app.people.limits import LOGIN
from app.session.owners import new_secret, owner_of
from app.shell.security import COOKIE
from app.shell.signing import secret_of, signed

_REMEMBERED = (
    400 * 24 * 3600
)  # seconds a browser keeps its cookie without accounts: as long as browsers allow


@dataclass(frozen=True)
class Visitor:
    """Who is asking.

    Args:
        owner: what his sessions hang on.
        secret: his browser's.
        person: who he is; None on a server without accounts.
    """

    owner: str
    secret: str
    person: Person | None = None


class Entrance:
    """Looks at cookies and asks the table of doors.

    Args:
        people: the accounts; None is a server without, for browsers of this machine alone.
    """

    def __init__(self, people: People | None):
        self.people = people
        self.key = b"" if people is None else server_key(people.database)

    async def who(self, asked: HTTPConnection, *, alive: bool = True) -> Visitor | None:
        """Who is asking; None for a stranger. Raises StorageError.

        Args:
            asked: the request or socket.
            alive: a person asked, not a clock: his log-in's rest begins anew.
        """
        people = self.people
        if people is None:
            cookie = asked.cookies.get(COOKIE, "")
            return Visitor(owner_of(cookie), cookie) if cookie else None
        secret = secret_of(self.key, asked.cookies.get(COOKIE, ""))
        if secret is None:
            return None

        def look_up() -> Person | None:
            id = people.logins.person(secret, alive=alive)
            if id is not None:
                return people.get(id)
            ended = people.logins.ran_out(secret)
            if ended is not None:
                people.audit.note(ended, "log_in_ended")
            return None

        person = await asyncio.to_thread(look_up)
        return None if person is None else Visitor(person.owner, secret, person)

    async def let(self, asked: HTTPConnection, deed: str, owner: str | None = None) -> Visitor | None:
        """Who is asking, where the table of doors lets him do this; None where it does not.

        Args:
            asked: the request or socket.
            deed: a key of the table.
            owner: of what it is done to; None asks for what is his own.
        """
        visitor = await self.who(asked)
        return visitor if visitor is not None and await self.may(visitor, deed, owner) else None

    async def may(self, visitor: Visitor, deed: str, owner: str | None = None) -> bool:
        """True where the table lets him; refusals of what is others' go into the audit log."""
        people, person = self.people, visitor.person
        owner = visitor.owner if owner is None else owner
        if people is None or person is None:
            return allowed(deed, "self") and owner == visitor.owner

        def ask() -> bool:
            may = people.may(person, deed, owner)
            if not may:
                people.audit.note(person.id, f"refused_{deed}", owner)
            return may

        return await asyncio.to_thread(ask)

    def newcomer(self) -> Visitor:
        """A browser that was never here, on a server without accounts."""
        secret = new_secret()
        return Visitor(owner_of(secret), secret)

    def give(self, answer: Response, asked: HTTPConnection, secret: str) -> None:
        """Hands the browser its secret."""
        named = self.people is not None
        value = signed(self.key, secret) if named else secret
        # Longer than it counts: who comes back with one that has ended is told so.
        self.set(answer, asked, COOKIE, value, 2 * int(LOGIN) if named else _REMEMBERED)

    def set(self, answer: Response, asked: HTTPConnection, name: str, value: str, seconds: int) -> None:
        """A cookie that scripts and other sites do not see, and that goes over TLS alone where we came by it."""
        answer.set_cookie(
            name,
            value,
            max_age=seconds,
            path=asked.scope.get("root_path") or "/",
            httponly=True,
            samesite="strict",
            secure=asked.url.scheme in ("https", "wss"),
        )

    def take(self, answer: Response, asked: HTTPConnection) -> None:
        """Takes the browser's secret away."""
        self.set(answer, asked, COOKIE, "", 0)
