"""A trainer's classes, and one of them: everybody, every lesson, what everybody does now."""

from __future__ import annotations

import asyncio
import time
from collections import Counter
from collections.abc import Sequence
from typing import Any

from starlette.responses import JSONResponse, Response
from starlette.routing import BaseRoute

from app.classroom.hints import LONGEST, Hint
from app.classroom.presence import Presence
from app.classroom.progress import Lesson
from app.classroom.working import STATES
from app.people import Person
from app.session.report import moment
from app.shell import readable
from app.shell.classroom.front import Asked, Front
from app.shell.security import HEADERS
from app.texts import text

#: Seconds a hint that was read is still said to be.
_READ = 600.0


class Classes:
    """Routes of classes.

    Args:
        front: what all pages share.
    """

    def __init__(self, front: Front):
        self._front, self._room = front, front.room
        self.routes: list[BaseRoute] = [
            front.route("/classes", self._list),
            front.route("/classes", self._make, "POST"),
            front.route("/class/{at}", self._class),
            front.route("/class/{at}", self._change, "POST"),
            front.route("/class/{at}/live", self._live),
        ]

    async def _list(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "class_make")
        trainer = None if asked.person.role == "administrator" else asked.person.id
        classes = await asyncio.to_thread(self._room.people.classes.list, trainer)
        return self._front.show(asked, "classes", classes=classes, place="classes")

    async def _make(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "class_make")
        classes = self._room.people.classes
        made = await asyncio.to_thread(classes.make, asked.form.get("name", ""), asked.person.id)
        return self._front.back(asked, f"/class/{made.id}", "made")

    async def _class(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        lessons = await asyncio.to_thread(self._room.lessons, at.id)
        seats = await asyncio.to_thread(self._room.seats, at.id)
        news = await asyncio.to_thread(self._news, asked, lessons, [seat.person for seat in seats])
        by_person = {one["person"]: one for one in news["seats"]}
        return self._front.show(
            asked,
            "class",
            at=at,
            lessons=lessons,
            seats=seats,
            counts=news["counts"],
            states=STATES,
            doing=lambda seat: by_person[seat.person.id],
            longest=LONGEST,
            trains=asked.person.id == at.trainer,
            place="classes",
        )

    async def _live(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        lessons = await asyncio.to_thread(self._room.lessons, at.id)
        persons = await asyncio.to_thread(self._room.members, at.id)
        news = await asyncio.to_thread(self._news, asked, lessons, persons)
        news["seats"] = list(map(readable.seat, news["seats"]))
        return JSONResponse(news, headers={**HEADERS, "Cache-Control": "no-store"})

    async def _change(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        classes, form = self._room.people.classes, asked.form
        match form.get("do"):
            case "rename":
                await asyncio.to_thread(lambda: classes.change(at.id, name=form.get("name", "")))
            case "code":
                await asyncio.to_thread(classes.new_code, at.id)
                return self._front.back(asked, f"/class/{at.id}", "new_code_is")
            case "delete":
                if not form.get("sure"):
                    return self._front.back(asked, f"/class/{at.id}/lessons")
                await asyncio.to_thread(self._room.delete, at.id, asked.person.id)
                return self._front.back(asked, "/classes", "deleted")
        return self._front.back(asked, f"/class/{at.id}/lessons", "kept")

    # What everybody does -----------------------------------------------------------------------------------

    def _news(self, asked: Asked, lessons: Sequence[Lesson], persons: Sequence[Person]) -> dict[str, Any]:
        owners, now = [person.owner for person in persons], time.time()
        seen = self._room.presences.of(owners, now)
        hints = self._room.hints.latest(owners)
        titles = {lesson.key: lesson.title(asked.language) for lesson in lessons}
        seats = [
            {
                "person": person.id,
                **_doing(seen.get(person.owner), titles, now, asked.language),
                "hint": _hinted(hints.get(person.owner), now, asked.language),
            }
            for person in persons
        ]
        counts = Counter(str(seat["state"]) for seat in seats)
        return {"seats": seats, "counts": {name: counts[name] for name in STATES}}


def _doing(one: Presence | None, titles: dict[str, str], now: float, language: str) -> dict[str, str]:
    """What somebody does, in words."""
    state = one.state if one is not None else "away"
    minutes = int((now - one.since) // 60) if one is not None else 0
    working = one is not None and one.exercise and state != "away"
    return {
        "state": state,
        "said": text(f"class.state_{state}", language),
        "for_": text("class.for_minutes", language, minutes=minutes)
        if minutes > 0 and state != "away"
        else "",
        "at": text(
            "class.at_lesson",
            language,
            title=titles.get(one.exercise, one.exercise),
            done=one.done,
            points=one.points,
        )
        if one is not None and working
        else moment(one.at, "%m-%d %H:%M")
        if one is not None and state == "away"
        else "",
    }


def _hinted(hint: Hint | None, now: float, language: str) -> str:
    """Whether the last hint was got."""
    if hint is None or (hint.put_away and now - hint.put_away > _READ):
        return ""
    return text(
        "class.hint_read" if hint.put_away else "class.hint_shown" if hint.shown else "class.hint_sent",
        language,
    )
