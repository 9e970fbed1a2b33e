"""A trainee's own page: what is next, and how he got better."""

from __future__ import annotations

import asyncio
import time
from typing import Any

from starlette.responses import Response
from starlette.routing import BaseRoute

from app.classroom.progress import next_lesson
from app.people import Person
from app.shell.classroom.front import Asked, Front, NotHereError
from app.shell.security import LOOK_COOKIE
from app.workers.lessons import open_lesson


class Mine:
    """Routes of a trainee's page.

    Args:
        front: what all pages share.
    """

    def __init__(self, front: Front):
        self._front, self._room, self._hub = front, front.room, front.hub
        self.routes: list[BaseRoute] = [
            front.route("/lessons", self._page),
            front.route("/lessons/{lesson}", self._open, "POST"),
        ]

    async def _page(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "records")
        rooms = await asyncio.to_thread(self._rooms, asked.person)
        return self._front.show(asked, "mine", rooms=rooms, place="lessons")

    def _rooms(self, person: Person) -> list[dict[str, Any]]:
        rooms = []
        for at, lessons in self._room.lessons_of(person.id):
            standings = self._room.standings(person, lessons)
            ahead = next_lesson(lessons, standings)
            late = ahead is not None and 0.0 < ahead.due < time.time()
            rooms.append({"at": at, "lessons": lessons, "standings": standings, "next": ahead, "late": late})
        return rooms

    async def _open(self, asked: Asked) -> Response:
        """His pendant, with this lesson chosen."""
        await self._front.may(asked.visitor, "work")
        rooms = await asyncio.to_thread(self._room.lessons_of, asked.person.id)
        found = next((one for _, lessons in rooms for one in lessons if one.id == asked["lesson"]), None)
        if found is None or found.exercise is None:
            raise NotHereError
        look = asked.request.cookies.get(LOOK_COOKIE)
        live = await asyncio.to_thread(self._hub.enter, asked.visitor.owner, look, asked.person)
        open_lesson(live, found.exercise)
        return self._front.back(asked, "/")
