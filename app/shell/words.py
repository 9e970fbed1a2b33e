"""The page's socket: beats and presses in, figures and changes out."""

from __future__ import annotations

import asyncio
import time
from typing import Any

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from app.errors import TeachframeError
from app.people.limits import MESSAGES
from app.shell import readable
from app.shell.entrance import Entrance, Visitor
from app.shell.messages import (
    VERSION,
    Beat,
    Cancel,
    Choose,
    File,
    Hello,
    Hinted,
    Home,
    In,
    Joint,
    Panel,
    Ping,
    Pong,
    Press,
    Release,
    Stop,
    Taken,
    heard,
    said,
)
from app.workers.hub import Hub
from app.workers.live import Live

_BETWEEN = 0.05  # seconds between two sets of figures: a press is answered at once
_STEADY, _FIRST = 0.1, 4  # the same after so many that came one upon the other: nobody reads twenty a second
_QUIET = (
    1.0  # seconds after which figures are sent though nothing was heard: the clock of an exercise goes on
)
_STILL = 5.0  # seconds between two looks whether the person is still logged in
TAKEN = 4001  # code with which a page that was taken over is closed
NOT_KNOWN = 4401  # nobody is logged in at this browser, or not any more
_SWITCHED = 4002  # the person's page goes on with another session


#: What a page says by itself: no sign that somebody sits before it. A held switch is one.
_IDLE = Ping


class Words:
    """One page.

    Args:
        socket: its socket, not yet accepted.
        live: the session it shows.
        hub: knows which page shows which session.
        entrance, visitor: who it is, and who knows whether he still is.
    """

    def __init__(self, socket: WebSocket, live: Live, hub: Hub, entrance: Entrance, visitor: Visitor):
        self._socket, self._live, self._hub = socket, live, hub
        self._entrance, self._visitor, self._heard = entrance, visitor, False
        self._news = asyncio.Event()
        self._given: set[str] = set()
        self._look: object = None  # as the page was told

    async def run(self) -> None:
        """Until the page is gone, or another page takes the session over."""
        await self._socket.accept()
        loop = asyncio.get_running_loop()

        def wake() -> None:
            # What is already told of is read after it was told: a tick of a moving arm wakes nobody twice.
            if not self._news.is_set() and not loop.is_closed():
                loop.call_soon_threadsafe(self._news.set)

        unlisten = self._live.listen(wake)
        self._hub.arrive(self._live, self)
        telling = asyncio.create_task(self._tell())
        watching = asyncio.create_task(self._watch())
        try:
            await self._hear()
        except (WebSocketDisconnect, RuntimeError):
            pass  # gone, as pages go
        finally:
            telling.cancel()
            watching.cancel()
            unlisten()
            self._hub.depart(self._live, self)
            for task in (await asyncio.wait((telling, watching)))[0]:
                _ = task.cancelled() or task.exception()  # what ended it is the page's going

    async def _hear(self) -> None:
        begun, count = time.monotonic(), 0
        while True:
            text = await self._socket.receive_text()
            await asyncio.sleep(0)  # what waits is given without a turn for others
            now = time.monotonic()
            begun, count = (begun, count + 1) if now - begun < MESSAGES.seconds else (now, 1)
            if count > MESSAGES.most:
                await asyncio.sleep(begun + MESSAGES.seconds - now)
            try:
                message = heard(text)
            except msgspec.DecodeError:
                continue  # no page of ours says such a thing
            if self._hub.shows(self._live, self):
                self._heard = self._heard or not isinstance(message, _IDLE)
                await self._obey(message)

    async def _obey(self, message: In) -> None:
        live = self._live
        match message:
            case Beat(en, axis, sign, press):
                live.beat(en, axis, sign, press)
            case Stop():
                live.stop()
            case Release():
                live.release()
            case Cancel():
                live.cancel()
            case Home():
                live.home()
            case Joint(axis, value):
                live.joint(axis, value)
            case Choose(what, value):
                live.choose(what, value)
            case Press(number, value):
                live.context.ui.hear(number, value)
            case Hinted(id, away):
                await asyncio.to_thread(live.hints.put_away if away else live.hints.got, id)
            case Ping(n):
                await self._socket.send_text(said(Pong(n)))

    async def _watch(self) -> None:
        """Closes the page where its log-in has ended: by hand elsewhere, by time, by an administrator."""
        while self._visitor.person is not None:
            await asyncio.sleep(_STILL)
            heard, self._heard = self._heard, False
            try:
                if await self._entrance.who(self._socket, alive=heard) is None:
                    self._live.let_go()
                    await self._socket.close(NOT_KNOWN)
                    return
            except TeachframeError:
                continue  # the database does not answer: that ends nobody's log-in

    async def _tell(self) -> None:
        revision, last, row = 0, "", -1
        while True:
            row += 1
            self._news.clear()
            if not self._hub.shows(self._live, self) or self._live.closed:
                await self._part()
                return
            await self._greet()
            whole = revision == 0
            revision, widgets, removed = self._live.context.ui.since(revision)
            if widgets or removed:
                await self._say(Panel([readable.widget(data) for data in widgets], removed, whole))
            for download in self._live.downloads():
                if download.token not in self._given:
                    self._given.add(download.token)
                    await self._say(File(download.token, download.name))
            figures = said(readable.frame(self._live.read()))
            if figures != last:
                last = figures
                await self._socket.send_text(figures)
            await asyncio.sleep(_BETWEEN if row < _FIRST else _STEADY)
            if self._news.is_set():
                continue
            row = -1
            try:
                await asyncio.wait_for(self._news.wait(), _QUIET)
            except TimeoutError:
                continue

    async def _greet(self) -> None:
        look = self._live.context.look
        if look != self._look:
            self._look = look
            person = self._visitor.person
            name = "" if person is None else person.name
            beside = "" if person is None else "lessons" if person.role == "trainee" else "classes"
            words = readable.texts(self._live.texts())
            await self._say(Hello(VERSION, self._live.choices(), words, name, beside))

    async def _part(self) -> None:
        if self._live.closed and not self._live.taken:
            await self._socket.close(_SWITCHED)
            return
        await self._say(Taken())
        await self._socket.close(TAKEN)

    async def _say(self, message: Any) -> None:
        await self._socket.send_text(said(message))
