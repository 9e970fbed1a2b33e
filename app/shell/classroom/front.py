"""What the pages of a class share: who may, forms, answers, times."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from starlette.requests import HTTPConnection, Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from app.classroom import Room
from app.classroom.progress import STEADY
from app.errors import TeachframeError
from app.people import Person
from app.people.classes import Class
from app.people.person import owner_of_person
from app.session.report import moment
from app.shell.coming_in import stale, to_login
from app.shell.entrance import Entrance, Visitor
from app.shell.forms import filled, language_of, page
from app.shell.security import HEADERS, PAGE_POLICY
from app.texts import error_text, text
from app.workers.hub import Hub

#: Fields and bytes of the largest form here: an exercise with its words in two languages, or its file.
_FIELDS, _BYTES = 80, 60_000
#: Deeds of the table of doors that are done to nobody's in particular.
OWNERLESS = ("class_make", "exercise_make")
#: What is said above a page after a form was taken: key of its text.
DONE = ("kept", "hinted", "assigned", "taken_away", "deleted", "dismissed", "made", "new_code_is", "pin")


class NotHereError(Exception):
    """There is no such class, person or lesson, or not for whoever asks."""


@dataclass(frozen=True)
class Asked:
    """A request that was let in.

    Args:
        request: itself.
        visitor, person: who asks.
        language: of the answer.
        form: what a form says; empty for a page.
    """

    request: Request
    visitor: Visitor
    person: Person
    language: str
    form: dict[str, str]

    def __getitem__(self, name: str) -> str:
        """A part of the address."""
        return str(self.request.path_params[name])


Job = Callable[[Asked], Awaitable[Response]]


class Front:
    """What the pages of a class share.

    Args:
        entrance: knows who is asking, and what he may.
        hub: all open sessions of this process.
    """

    def __init__(self, entrance: Entrance, hub: Hub):
        self.entrance, self.hub = entrance, hub
        self.room: Room = hub.room

    def route(self, path: str, job: Job, method: str = "GET") -> Route:
        """A door: strangers are sent to log in, forms need their token, what cannot be is one line."""

        async def answer(request: Request) -> Response:
            visitor = await self.entrance.who(request)
            if visitor is None or visitor.person is None:
                asks = "application/json" in request.headers.get("accept", "")  # a script, not a person
                return Response(status_code=401, headers=HEADERS) if asks else to_login(request)
            asked = Asked(request, visitor, visitor.person, language_of(request), {})
            try:
                if method == "POST":
                    form = await filled(self.entrance, request, fields=_FIELDS, largest=_BYTES)
                    if form is None:
                        return self.problem(asked, 403, stale())
                    asked = Asked(request, visitor, visitor.person, asked.language, form)
                return await job(asked)
            except NotHereError:
                return self.problem(asked, 404)
            except TeachframeError as error:
                return self.problem(asked, 400, error)

        return Route(path, answer, methods=[method])

    # Who may ----------------------------------------------------------------------------------------------

    async def may(self, visitor: Visitor, deed: str, owner: str | None = None) -> None:
        """Raises NotHereError where the table of doors does not let him."""
        if deed in OWNERLESS:
            may = self.room.people.may(visitor.person, deed)  # looks into no table of the database
        else:
            may = await self.entrance.may(visitor, deed, owner)
        if not may:
            raise NotHereError

    async def at(self, asked: Asked | HTTPConnection, visitor: Visitor | None = None) -> Class:
        """The class an address names, for its trainer or an administrator; raises NotHereError."""
        request = asked.request if isinstance(asked, Asked) else asked
        visitor = asked.visitor if isinstance(asked, Asked) else visitor
        found = await asyncio.to_thread(self.room.people.classes.get, str(request.path_params["at"]))
        if found is None or visitor is None:
            raise NotHereError
        await self.may(visitor, "class_change", owner_of_person(found.trainer))
        return found

    async def trainee(self, asked: Asked | HTTPConnection, at: Class) -> Person:
        """The member of a class an address names; raises NotHereError."""
        request = asked.request if isinstance(asked, Asked) else asked
        id = str(request.path_params["who"])
        members = await asyncio.to_thread(self.room.members, at.id)
        found = next((one for one in members if one.id == id), None)
        if found is None:
            raise NotHereError
        return found

    # Answers ----------------------------------------------------------------------------------------------

    def show(self, asked: Asked, name: str, *, status: int = 200, **fields: Any) -> Response:
        """A page from its template."""
        done = asked.request.query_params.get("done", "")
        usual = {
            "person": asked.person,
            "place": "",
            "said": text(f"class.done_{done}", asked.language) if done in DONE else "",
            "level": "good",
            "moment": lambda at: moment(at, "%m-%d %H:%M"),
            "clock": lambda seconds: f"{int(seconds) // 60}:{int(seconds) % 60:02d}",
            "steady": STEADY,
        }
        return page(
            self.entrance,
            asked.request,
            f"class/{name}",
            status=status,
            policy=PAGE_POLICY,
            **{**usual, **fields},
        )

    def problem(self, asked: Asked, status: int, error: TeachframeError | None = None) -> Response:
        """One line, instead of a page."""
        words = (
            text("class.not_known", asked.language) if error is None else error_text(error, asked.language)
        )
        return self.show(asked, "problem", status=status, words=words)

    def back(self, asked: Asked, path: str, done: str = "") -> Response:
        """The page again, after a form."""
        root = asked.request.scope.get("root_path", "")
        return RedirectResponse(f"{root}{path}{'?done=' + done if done else ''}", 303, HEADERS)


def local(at: float) -> str:
    """A time as a form's field has it, by this machine's clock; empty for none."""
    return time.strftime("%Y-%m-%dT%H:%M", time.localtime(at)) if at else ""


def due(written: str) -> float:
    """Seconds since 1970 of a form's field; 0 where it is empty or no time."""
    for shape in ("%Y-%m-%dT%H:%M", "%Y-%m-%dT%H:%M:%S"):
        try:
            return time.mktime(time.strptime(written, shape))
        except (ValueError, OverflowError):
            continue
    return 0.0
