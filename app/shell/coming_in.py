"""Log in, join a class, log out."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from starlette.requests import Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route

from app.errors import PersonRefusedError
from app.people import People, Person
from app.people.limits import HASHES, IDLE, LOGIN, WAITING
from app.people.refusals import refused
from app.shell.entrance import Entrance
from app.shell.forms import filled, language_of, page, remember
from app.shell.security import COOKIE, HEADERS, LOOK_COOKIE

#: Why not -> status of the answer; others are 400.
_STATUS = {"wrong": 401, "locked": 403, "slowly": 429, "busy": 503}


class ComingIn:
    """Routes of who comes and goes.

    Args:
        entrance: knows who is asking.
        people: the accounts.
        outside: address of a log-in at another place, and its name, where there is one.
    """

    def __init__(self, entrance: Entrance, people: People, outside: tuple[str, str] | None = None):
        self._entrance, self._people, self.outside = entrance, people, outside
        self._hashing, self._waiting = ThreadPoolExecutor(HASHES, "log-in"), 0
        self.routes = [
            Route("/login", self._login, methods=["GET", "POST"]),
            Route("/join", self._join, methods=["GET", "POST"]),
            Route("/logout", self._logout, methods=["POST"]),
        ]

    async def _login(self, request: Request) -> Response:
        def come(said: dict[str, str], address: str) -> Person:
            return self._people.authenticate(said.get("login", ""), said.get("secret", ""), address)

        return await self._answer(request, "login", come)

    async def _join(self, request: Request) -> Response:
        def come(said: dict[str, str], address: str) -> Person:
            return self._people.join(said.get("code", ""), said.get("name", ""), said.get("pin", ""), address)

        return await self._answer(request, "join", come)

    async def _answer(
        self, request: Request, name: str, come: Callable[[dict[str, str], str], Person]
    ) -> Response:
        hours = {"rest": int(IDLE // 3600), "most": int(LOGIN // 3600)}
        fields = {"said": dict(request.query_params), "outside": self.outside, "hours": hours}
        if request.method == "GET":
            return page(self._entrance, request, name, **fields)
        said = await filled(self._entrance, request)
        if said is None:
            return page(self._entrance, request, name, status=403, error=stale(), **fields)
        address = request.client.host if request.client else ""
        try:
            person = await self._wait(come, said, address)
        except PersonRefusedError as error:
            status = _STATUS.get(error.why, 400)
            return page(self._entrance, request, name, status=status, error=error, **{**fields, "said": said})
        return await self.welcome(request, person)

    async def _wait(
        self, come: Callable[[dict[str, str], str], Person], said: dict[str, str], address: str
    ) -> Person:
        """On a thread for this alone: however many guess, nobody else waits for a thread."""
        if self._waiting >= WAITING:
            raise refused("busy")
        self._waiting += 1
        try:
            return await asyncio.get_running_loop().run_in_executor(self._hashing, come, said, address)
        finally:
            self._waiting -= 1

    async def welcome(self, request: Request, person: Person) -> Response:
        """The person is in: a secret that was never in a browser before, and his page."""
        before = await self._entrance.who(request)
        if before is not None:
            await asyncio.to_thread(self._people.logins.end, before.secret)
        secret = await asyncio.to_thread(self._people.logins.begin, person.id)
        answer = RedirectResponse(f"{request.scope.get('root_path', '')}/", 303, HEADERS)
        self._entrance.give(answer, request, secret)
        if LOOK_COOKIE not in request.cookies:  # the pendant goes on in the language of the log-in page
            remember(answer, request, language_of(request))
        return answer

    async def _logout(self, request: Request) -> Response:
        visitor = await self._entrance.who(request)
        if visitor is None:
            return to_login(request)
        if await filled(self._entrance, request) is None:
            return PlainTextResponse(str(stale()), 403, HEADERS)
        await asyncio.to_thread(self._people.logins.end, visitor.secret)
        if visitor.person is not None:
            await asyncio.to_thread(self._people.audit.note, visitor.person.id, "log_out")
        answer = to_login(request, left=True)
        self._entrance.take(answer, request)
        return answer


def to_login(request: Request, *, left: bool = False) -> Response:
    """The log-in page instead; who was logged in reads there that it has ended, unless he `left` himself."""
    ended = "?ended=1" if request.cookies.get(COOKIE) and not left else ""
    return RedirectResponse(f"{request.scope.get('root_path', '')}/login{ended}", 303, HEADERS)


def stale() -> PersonRefusedError:
    """A form that did not come from a page of ours, or lay open for too long."""
    return refused("stale")
