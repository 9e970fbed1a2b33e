"""One trainee of a class: how he stands, hints to him, copies of his sessions, out of the class."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass

from starlette.responses import Response
from starlette.routing import BaseRoute

from app.classroom.hints import LONGEST
from app.people import Person
from app.session.report import moment
from app.shell.classroom.front import Asked, Front, NotHereError
from app.texts import text

#: Sessions of a trainee that are listed.
_SESSIONS = 40


@dataclass(frozen=True)
class Listed:
    """A session in the list: its name, what it is called, its last action (seconds since 1970), how many it has."""

    name: str
    title: str
    last: float
    actions: int


class People:
    """Routes of the trainees of a class.

    Args:
        front: what all pages share.
    """

    def __init__(self, front: Front):
        self._front, self._room, self._hub = front, front.room, front.hub
        self.routes: list[BaseRoute] = [
            front.route("/class/{at}/person/{who}", self._person),
            front.route("/class/{at}/hint/{who}", self._hint, "POST"),
            front.route("/class/{at}/copy/{who}", self._copy, "POST"),
            front.route("/class/{at}/pin/{who}", self._pin, "POST"),
            front.route("/class/{at}/dismiss/{who}", self._dismiss, "POST"),
        ]

    async def _person(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        who = await self._front.trainee(asked, at)
        await self._front.may(asked.visitor, "records", who.owner)
        lessons = await asyncio.to_thread(self._room.lessons, at.id)
        return self._front.show(
            asked,
            "person",
            at=at,
            who=who,
            lessons=lessons,
            standings=await asyncio.to_thread(self._room.standings, who, lessons),
            hints=await asyncio.to_thread(self._room.hints.of, who.owner),
            sessions=await asyncio.to_thread(self._sessions, who),
            longest=LONGEST,
            place="classes",
        )

    async def _hint(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        who = await self._front.trainee(asked, at)
        await self._front.may(asked.visitor, "hint", who.owner)
        words = asked.form.get("text", "")
        await asyncio.to_thread(self._room.hints.send, asked.person.id, who.owner, words)
        await asyncio.to_thread(self._room.people.audit.note, asked.person.id, "hint", who.id)
        self._hub.attending.nudge()
        back = f"/class/{at.id}/watch/{who.id}" if asked.form.get("back") == "watch" else f"/class/{at.id}"
        return self._front.back(asked, back, "hinted")

    async def _copy(self, asked: Asked) -> Response:
        """A copy of a session, the one open now unless one is named; the trainer's own pendant opens it."""
        at = await self._front.at(asked)
        who = await self._front.trainee(asked, at)
        await self._front.may(asked.visitor, "copy", who.owner)
        await asyncio.to_thread(self._take, asked, who)
        await asyncio.to_thread(self._room.people.audit.note, asked.person.id, "copy", who.id)
        return self._front.back(asked, "/")

    def _take(self, asked: Asked, who: Person) -> None:
        owners, store = self._hub.owners, self._hub.store
        name = asked.form.get("session") or owners.latest(who.owner)
        if name is None or name not in owners.titles(who.owner):
            raise NotHereError
        copy = store.take(store.recorded(name))
        when = moment(time.time(), "%m-%d %H:%M")
        title = text("class.copy_title", asked.language, name=who.name, time=when)
        owners.give(copy, asked.visitor.owner, title)
        live = self._hub.find(asked.visitor.owner)
        if live is not None:  # else his page opens it: it is the one he had last
            live.context.shelf.switch(copy)

    async def _pin(self, asked: Asked) -> Response:
        """Another PIN, which unlocks him, too; for trainees only: whoever may more is an administrator's to reset."""
        at = await self._front.at(asked)
        who = await self._front.trainee(asked, at)
        await self._front.may(asked.visitor, "reset", who.owner)
        if who.role != "trainee" and asked.person.role != "administrator":
            raise NotHereError
        change = self._room.people.change
        await asyncio.to_thread(change, who.id, by=asked.person.id, pin=asked.form.get("pin", ""))
        return self._front.back(asked, f"/class/{at.id}/person/{who.id}", "pin")

    async def _dismiss(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        who = await self._front.trainee(asked, at)
        if not asked.form.get("sure"):
            return self._front.back(asked, f"/class/{at.id}/person/{who.id}")
        await asyncio.to_thread(self._room.people.classes.dismiss, at.id, who.id)
        await asyncio.to_thread(self._room.people.audit.note, asked.person.id, "dismiss", who.id)
        return self._front.back(asked, f"/class/{at.id}", "dismissed")

    def _sessions(self, who: Person) -> list[Listed]:
        titles = self._hub.owners.titles(who.owner)
        return [
            Listed(one.name, titles[one.name] or moment(one.created, "%Y-%m-%d %H:%M"), one.last, one.actions)
            for one in self._hub.store.list(_SESSIONS, titles.keys())
        ]
