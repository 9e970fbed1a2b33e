"""Exercises made here: listed, made from fields or from a file, tried at once."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from typing import Any

from starlette.responses import Response
from starlette.routing import BaseRoute

from app.calibration.vocabularies import vocabulary
from app.classroom.assignments import HELPS
from app.classroom.making import ACTIVE, GOALS, MODES, NUMBERS, WRONG, drafted, tried, usual
from app.errors import TeachframeError
from app.kinematics import robot_names
from app.session.state import mode_named, robot_named
from app.shell.classroom.front import Asked, Front
from app.shell.security import HEADERS, LOOK_COOKIE
from app.texts import FALLBACK, error_text, text
from app.training.exercise import made_exercise
from app.workers.lessons import open_lesson


@dataclass(frozen=True)
class Row:
    """One exercise in the list: key, title, when it was made (seconds since 1970), what is wrong with its file."""

    key: str
    title: str
    created: float
    problem: str


class Exercises:
    """Routes of exercises made here.

    Args:
        front: what all pages share.
    """

    def __init__(self, front: Front):
        self._front, self._room, self._hub = front, front.room, front.hub
        self.routes: list[BaseRoute] = [
            front.route("/exercises", self._list),
            front.route("/exercises/new", self._new),
            front.route("/exercises/new", self._made, "POST"),
            front.route("/exercises/file", self._file, "POST"),
            front.route("/exercises/{key}.toml", self._text),
            front.route("/exercises/{key}", self._one, "POST"),
        ]

    async def _list(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "exercise_make")
        return await self._page(asked)

    async def _page(self, asked: Asked, mistakes: list[str] | None = None, written: str = "") -> Response:
        rows = await asyncio.to_thread(self._rows, asked)
        return self._front.show(
            asked,
            "exercises",
            status=400 if mistakes else 200,
            made=rows,
            mistakes=mistakes or [],
            text=written,
            place="exercises",
        )

    def _rows(self, asked: Asked) -> list[Row]:
        rows = []
        for kept in self._room.made.of(asked.person.id):
            try:
                title, problem = made_exercise(kept.lesson).said(asked.language).title, ""
            except TeachframeError as error:
                title, problem = kept.key, error_text(error, asked.language)
            rows.append(Row(kept.key, title, kept.created, problem))
        return rows

    async def _new(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "exercise_make")
        return self._form(asked, usual(), [])

    async def _made(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "exercise_make")
        draft = await asyncio.to_thread(drafted, asked.form, asked.language)
        if draft.mistakes:
            return self._form(asked, asked.form, [line.text(asked.language) for line in draft.mistakes])
        return await self._take(asked, draft.text)

    async def _file(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "exercise_make")
        written = asked.form.get("text", "").replace("\r\n", "\n")
        mistakes = await asyncio.to_thread(tried, written, asked.language)
        if mistakes:
            return await self._page(asked, [line.text(asked.language) for line in mistakes], written)
        return await self._take(asked, written)

    async def _take(self, asked: Asked, written: str) -> Response:
        """Keeps a file, or begins what it says in the trainer's own session."""
        if asked.form.get("do") == "try":
            return await self._try(asked, written)
        await asyncio.to_thread(self._room.made.keep, asked.person.id, written)
        return self._front.back(asked, "/exercises", "kept")

    async def _one(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "exercise_make")
        key, mine = asked["key"], await asyncio.to_thread(self._room.made.of, asked.person.id)
        kept = next((one for one in mine if one.key == key), None)
        if kept is not None and asked.form.get("do") == "try":
            return await self._try(asked, kept.lesson)
        if kept is not None and asked.form.get("do") == "away":
            await asyncio.to_thread(self._room.made.put_away, asked.person.id, key)
        return self._front.back(asked, "/exercises", "taken_away")

    async def _try(self, asked: Asked, written: str) -> Response:
        chosen = await asyncio.to_thread(made_exercise, written)
        look = asked.request.cookies.get(LOOK_COOKIE)
        live = await asyncio.to_thread(self._hub.enter, asked.visitor.owner, look, asked.person)
        open_lesson(live, chosen, begin=True)
        return self._front.back(asked, "/")

    async def _text(self, asked: Asked) -> Response:
        await self._front.may(asked.visitor, "exercise_make")
        written = await asyncio.to_thread(self._room.made.text, asked["key"])
        headers = {
            **HEADERS,
            "Content-Disposition": f'attachment; filename="{asked["key"][:40]}.toml"',
            "Content-Security-Policy": "default-src 'none'; sandbox",
        }
        return Response(written, media_type="application/toml", headers=headers)

    def _form(self, asked: Asked, fields: dict[str, str], mistakes: list[str]) -> Response:
        language = asked.language
        shown: dict[str, Any] = {**dict.fromkeys(usual(), ""), "ask": "", **fields}
        return self._front.show(
            asked,
            "making",
            status=400 if mistakes else 200,
            fields=shown,
            mistakes=mistakes,
            numbers=NUMBERS,
            robots=robot_names(),
            robot_title=lambda name: robot_named(name).said("title", language),
            goals=GOALS,
            goal_title=lambda key: text(f"making.goal_{key}", language),
            modes=MODES,
            mode_title=lambda key: _mode(key, language),
            actives=ACTIVE,
            active_title=lambda key: text(f"making.active_{key}", language),
            wrongs=WRONG,
            wrong_title=lambda key: text(f"training.answer_{key}", language),
            help_names=HELPS,
            place="exercises",
        )


def _mode(key: str, language: str) -> str:
    """What a wizard mode is called."""
    title = mode_named(key).title
    return vocabulary("paper").mode_title(key, title, language) if language != FALLBACK else title
