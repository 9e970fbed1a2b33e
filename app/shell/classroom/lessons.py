"""Lessons of a class: assigned, ordered, with due times and helps; where points are lost in one."""

from __future__ import annotations

import asyncio
from typing import Any

from starlette.responses import Response
from starlette.routing import BaseRoute

from app.classroom.assignments import HELPS
from app.errors import TeachframeError
from app.people.classes import Class
from app.shell.classroom.front import Asked, Front, NotHereError, due, local
from app.training.exercise import Exercise, exercises

_MOVES = {"up": -1, "down": 1}


class Lessons:
    """Routes of a class's lessons.

    Args:
        front: what all pages share.
    """

    def __init__(self, front: Front):
        self._front, self._room = front, front.room
        self.routes: list[BaseRoute] = [
            front.route("/class/{at}/lessons", self._list),
            front.route("/class/{at}/lessons", self._assign, "POST"),
            front.route("/class/{at}/helps", self._helps, "POST"),
            front.route("/class/{at}/lesson/{lesson}", self._lost),
            front.route("/class/{at}/lesson/{lesson}", self._change, "POST"),
        ]

    async def _list(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        fields = await asyncio.to_thread(self._fields, at, asked.person.id)
        return self._front.show(asked, "lessons", at=at, place="classes", **fields)

    def _fields(self, at: Class, author: str) -> dict[str, Any]:
        room = self._room
        lessons = room.lessons(at.id)
        given = {lesson.key for lesson in lessons}
        return {
            "lessons": lessons,
            "made": [one for one in self._made(author) if one.key not in given],
            "shipped": [one for one in exercises().values() if one.key not in given],
            "without": room.assignments.without(at.id),
            "help_names": HELPS,
            "local": local,
        }

    def _made(self, author: str) -> list[Exercise]:
        """What the trainer made and can be read."""
        found = []
        for kept in self._room.made.of(author):
            try:
                found.append(self._room.made.exercise(kept.key))
            except TeachframeError:  # his page of exercises says why
                continue
        return found

    async def _assign(self, asked: Asked) -> Response:
        at, key = await self._front.at(asked), asked.form.get("exercise", "")

        def assign() -> None:
            self._room.made.exercise(key)  # it must be there, and good
            self._room.assignments.give(at.id, key, due(asked.form.get("due", "")))

        await asyncio.to_thread(assign)
        return self._front.back(asked, f"/class/{at.id}/lessons", "assigned")

    async def _helps(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        await asyncio.to_thread(self._room.assignments.forbid, at.id, _without(asked.form))
        return self._front.back(asked, f"/class/{at.id}/lessons", "kept")

    async def _change(self, asked: Asked) -> Response:
        at, id, form = await self._front.at(asked), asked["lesson"], asked.form
        assignments, done = self._room.assignments, "kept"
        match form.get("do"):
            case "up" | "down" as where:
                await asyncio.to_thread(assignments.move, at.id, id, _MOVES[where])
            case "away":
                await asyncio.to_thread(assignments.take_away, at.id, id)
                done = "taken_away"
            case "change":
                by = due(form.get("due", ""))
                await asyncio.to_thread(lambda: assignments.change(at.id, id, due=by, without=_without(form)))
        return self._front.back(asked, f"/class/{at.id}/lessons", done)

    async def _lost(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        lessons = await asyncio.to_thread(self._room.lessons, at.id)
        lesson = next((one for one in lessons if one.id == asked["lesson"]), None)
        if lesson is None:
            raise NotHereError
        lost = await asyncio.to_thread(self._room.losses, at.id, lesson)
        return self._front.show(asked, "lesson", at=at, lesson=lesson, lost=lost, place="classes")


def _without(form: dict[str, str]) -> list[str]:
    """Helps whose boxes are not ticked."""
    return [name for name in HELPS if f"help_{name}" not in form]
