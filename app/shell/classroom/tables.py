"""Scores and grades of a class as files."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from urllib.parse import quote

from starlette.responses import Response
from starlette.routing import BaseRoute

from app.classroom.grades import canvas_csv, moodle_csv, scores_csv
from app.shell.classroom.front import Asked, Front, Job
from app.shell.security import HEADERS

#: UTF-8's mark, by which a spreadsheet knows the names' letters; the two platforms would take it for part of a name.
_MARK = "\ufeff"


class Tables:
    """Routes of a class's tables.

    Args:
        front: what all pages share.
    """

    def __init__(self, front: Front):
        self._front, self._room = front, front.room
        kinds: dict[str, Callable[..., str]] = {
            "scores": lambda rows, lessons, at, tongue: _MARK + scores_csv(rows, lessons, tongue),
            "moodle": lambda rows, lessons, at, tongue: moodle_csv(rows, lessons, tongue),
            "canvas": lambda rows, lessons, at, tongue: canvas_csv(rows, lessons, tongue, at),
        }
        self.routes: list[BaseRoute] = [
            front.route(f"/class/{{at}}/{name}.csv", self._table(name, written))
            for name, written in kinds.items()
        ]

    def _table(self, name: str, written: Callable[..., str]) -> Job:
        async def answer(asked: Asked) -> Response:
            at = await self._front.at(asked)
            lessons = await asyncio.to_thread(self._room.lessons, at.id)
            rows = await asyncio.to_thread(self._room.rows, at.id)
            content = written(rows, lessons, at.name, asked.language)
            await asyncio.to_thread(self._room.people.audit.note, asked.person.id, f"export_{name}", at.id)
            headers = {
                **HEADERS,
                "Content-Disposition": f"attachment; filename*=UTF-8''{quote(f'{at.name}_{name}.csv', safe='')}",
                "Content-Security-Policy": "default-src 'none'; sandbox",
                "Cache-Control": "no-store",
            }
            return Response(content, media_type="text/csv; charset=utf-8", headers=headers)

        return answer
