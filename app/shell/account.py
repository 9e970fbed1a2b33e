"""A person's own account: his classes, another secret, everything kept about him, erased where he wants."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from app.errors import PersonRefusedError
from app.people import People
from app.people.belongings import erase, everything
from app.people.refusals import refused
from app.shell.coming_in import stale, to_login
from app.shell.entrance import Entrance, Visitor
from app.shell.forms import filled, page
from app.shell.security import HEADERS


class Account:
    """Routes of the account page.

    Args:
        entrance: knows who is asking.
        people: the accounts.
        leave: closes what somebody has open, by his owner string.
    """

    def __init__(self, entrance: Entrance, people: People, leave: Callable[[str], None]):
        self._entrance, self._people, self._leave = entrance, people, leave
        self.routes = [
            Route("/account", self._account),
            Route("/account/secret", self._secret, methods=["POST"]),
            Route("/account/join", self._join, methods=["POST"]),
            Route("/account/export", self._export, methods=["POST"]),
            Route("/account/erase", self._erase, methods=["POST"]),
        ]

    async def _account(self, request: Request) -> Response:
        visitor = await self._entrance.let(request, "account")
        return to_login(request) if visitor is None else await self._page(request, visitor)

    async def _secret(self, request: Request) -> Response:
        def change(visitor: Visitor, said: dict[str, str]) -> None:
            person = visitor.person
            assert person is not None
            self._prove(visitor, said, request)
            new = said.get("new", "")
            if new != said.get("again", ""):
                raise refused("not_twice")
            if person.role == "trainee" and new.isdigit():
                self._people.change(person.id, by=person.id, pin=new)
            else:
                self._people.change(person.id, by=person.id, secret=new)

        return await self._do(request, "account", change)

    async def _join(self, request: Request) -> Response:
        def join(visitor: Visitor, said: dict[str, str]) -> None:
            assert visitor.person is not None
            self._people.enroll(said.get("code", ""), visitor.person, _address(request))

        return await self._do(request, "account", join)

    async def _export(self, request: Request) -> Response:
        visitor, said = await self._entrance.let(request, "take_along"), await filled(self._entrance, request)
        if visitor is None or visitor.person is None:
            return to_login(request)
        if said is None:
            return await self._page(request, visitor, 403, stale())
        content = await asyncio.to_thread(everything, self._people, visitor.person, visitor.person.id)
        headers = {
            **HEADERS,
            "Content-Disposition": 'attachment; filename="teachframe_everything.zip"',
            "Content-Security-Policy": "default-src 'none'; sandbox",
            "Cache-Control": "no-store",
        }
        return Response(content, media_type="application/zip", headers=headers)

    async def _erase(self, request: Request) -> Response:
        def gone(visitor: Visitor, said: dict[str, str]) -> None:
            person = visitor.person
            assert person is not None
            self._prove(visitor, said, request)
            self._people.must_be_erasable(person)
            self._people.logins.end_all(person.id)
            self._leave(person.owner)
            erase(self._people, person, person.id)

        answer = await self._do(request, "erase", gone)
        if answer.status_code != 303:
            return answer
        answer = to_login(request, left=True)
        self._entrance.take(answer, request)
        return answer

    def _prove(self, visitor: Visitor, said: dict[str, str], request: Request) -> None:
        """Raises PersonRefusedError unless the secret is typed once more: the computer may be another's by now."""
        if visitor.person is not None and self._people.has_secret(visitor.person.id):
            self._people.authenticate(visitor.person.login, said.get("secret", ""), _address(request))

    async def _do(
        self, request: Request, deed: str, job: Callable[[Visitor, dict[str, str]], None]
    ) -> Response:
        visitor = await self._entrance.let(request, deed)
        if visitor is None:
            return to_login(request)
        said = await filled(self._entrance, request)
        if said is None:
            return await self._page(request, visitor, 403, stale())
        try:
            await asyncio.to_thread(job, visitor, said)
        except PersonRefusedError as error:
            return await self._page(request, visitor, 400, error)
        return RedirectResponse(f"{request.scope.get('root_path', '')}/account", 303, HEADERS)

    async def _page(
        self, request: Request, visitor: Visitor, status: int = 200, error: PersonRefusedError | None = None
    ) -> Response:
        person = visitor.person
        assert person is not None

        def read() -> dict[str, Any]:
            classes = self._people.classes
            names = {c.id: self._people.get(c.trainer) for c in classes.of(person.id)}
            return {
                "person": person,
                "mine": classes.of(person.id),
                "trainers": {id: t.name if t else "" for id, t in names.items()},
                "trained": [(c, len(classes.members(c.id))) for c in classes.list(trainer=person.id)],
                "has_secret": self._people.has_secret(person.id),
            }

        fields = await asyncio.to_thread(read)
        return page(self._entrance, request, "account", status=status, error=error, **fields)


def _address(request: Request) -> str:
    return request.client.host if request.client else ""
