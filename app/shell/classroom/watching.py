"""A trainee's arm live, read only: his scene and his figures come, nothing goes; he is told that somebody watches."""

from __future__ import annotations

import asyncio
import contextlib

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from app.classroom.hints import LONGEST
from app.errors import TeachframeError
from app.people import Person
from app.shell import readable
from app.shell.bridge import scene_page, watch_scene
from app.shell.classroom.front import Asked, Front, NotHereError
from app.shell.coming_in import to_login
from app.shell.elsewhere import sent_on
from app.shell.forms import is_dark
from app.shell.messages import said
from app.shell.security import HEADERS
from app.workers.live import Live

_BETWEEN = 0.05  # seconds between two sets of figures
_QUIET = 1.0  # seconds after which figures are sent though nothing was heard
#: Seconds between two looks whether whoever watches still may: he logs out, the trainee leaves the class.
_ASKED = 5.0
_NOT_YOU, _NOBODY, _SWITCHED = 4401, 4404, 4002


class Watching:
    """Routes of watching.

    Args:
        front: what all pages share.
    """

    def __init__(self, front: Front):
        self._front, self._hub = front, front.hub
        self.routes: list[BaseRoute] = [
            front.route("/class/{at}/watch/{who}", self._page),
            Route("/class/{at}/watch/{who}/scene/", self._scene),
            WebSocketRoute("/class/{at}/watch/{who}/scene", self._scene_socket),
            WebSocketRoute("/class/{at}/watch/{who}/words", self._words),
        ]

    async def _page(self, asked: Asked) -> Response:
        at = await self._front.at(asked)
        who = await self._front.trainee(asked, at)
        await self._front.may(asked.visitor, "watch", who.owner)
        await asyncio.to_thread(self._front.room.people.audit.note, asked.person.id, "watch", who.id)
        return self._front.show(asked, "watch", at=at, who=who, longest=LONGEST, place="classes")

    async def _scene(self, request: Request) -> Response:
        if await self._front.entrance.who(request) is None:
            return to_login(request)
        try:
            await self._watched(request)
        except NotHereError:
            return Response(status_code=404, headers=HEADERS)
        return scene_page(request)

    async def _scene_socket(self, page: WebSocket) -> None:
        live = await self._live(page)
        if live is not None:
            await watch_scene(page, live, dark=is_dark(page))

    async def _words(self, page: WebSocket) -> None:
        live = await self._live(page)
        if live is None:
            return
        await page.accept()
        with live.hints.watching():
            telling = asyncio.create_task(self._told(page, live))
            try:
                await _deaf(page)
            finally:
                telling.cancel()
                await asyncio.wait({telling})

    async def _told(self, page: WebSocket, live: Live) -> None:
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # gone, as pages go
            await self._tell(page, live)

    async def _tell(self, page: WebSocket, live: Live) -> None:
        """The figures whenever something changes, until the session is closed or whoever watches may not any more."""
        loop, news = asyncio.get_running_loop(), asyncio.Event()

        def wake() -> None:
            if not loop.is_closed():
                loop.call_soon_threadsafe(news.set)

        unlisten = live.listen(wake)
        last, asked = "", loop.time()
        try:
            while not live.closed:
                news.clear()
                figures = said(readable.frame(live.read()))
                if figures != last:
                    last = figures
                    await page.send_text(figures)
                await asyncio.sleep(_BETWEEN)
                if loop.time() - asked > _ASKED:
                    asked = loop.time()
                    with contextlib.suppress(
                        TeachframeError
                    ):  # the database does not answer: that shuts nobody out
                        await self._watched(page, alive=False)
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(news.wait(), _QUIET)
            await page.close(_SWITCHED)
        except NotHereError:
            await page.close(_NOT_YOU)
        finally:
            unlisten()

    async def _live(self, page: WebSocket) -> Live | None:
        """The open session that is to be watched; None, and the socket is closed, where it must or can not be."""
        try:
            who = await self._watched(page)
        except NotHereError:
            await page.close(_NOT_YOU)
            return None
        live = self._hub.find(who.owner)
        if live is None:
            process = await asyncio.to_thread(self._hub.elsewhere, who.owner)
            if process is not None and await sent_on(page, process):
                return None
            await page.accept(subprotocol=next(iter(page.scope["subprotocols"]), None))
            await page.close(_NOBODY)
        return live

    async def _watched(self, asked: Request | WebSocket, *, alive: bool = True) -> Person:
        """Whom an address names; raises NotHereError unless whoever asks may watch him."""
        visitor = await self._front.entrance.who(asked, alive=alive)
        if visitor is None or visitor.person is None:
            raise NotHereError
        at = await self._front.at(asked, visitor)
        who = await self._front.trainee(asked, at)
        await self._front.may(visitor, "watch", who.owner)
        return who


async def _deaf(page: WebSocket) -> None:
    """Hears until the page is gone, and heeds nothing."""
    while True:
        message = await page.receive()
        if message["type"] == "websocket.disconnect":
            return
