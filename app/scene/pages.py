"""How a scene gets to its pages: over sockets that the shell has let in, on the shell's own loop.

viser serves each scene from a port, a thread and an event loop of its own. With fifty sessions in a process these take
turns for one interpreter, and every frame goes through two sockets more; and a port answers whoever tries it. Here is
none of them. viser is pinned (1.1.1): what is replaced is its `WebsockServer.start`, `stop` and handler.
"""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Callable, Coroutine
from typing import Any, Protocol

from viser.infra import WebsockServer
from viser.infra import _infra as viser_infra
from viser.infra._async_message_buffer import AsyncMessageBuffer


class Frames(Protocol):
    """One page's socket."""

    async def send(self, frame: bytes, /) -> None:
        """To the page; awaiting it is the back-pressure."""
        ...

    async def recv(self) -> bytes:
        """From the page; what it raises ends the showing."""
        ...


class PagesLoop:
    """Stands for the loop of whoever looks: while nobody does there is nothing to wake, and one that was woken and has
    not had its turn is not woken again."""

    def __init__(self):
        self._real: asyncio.AbstractEventLoop | None = None
        self._due: set[Callable[..., object]] = set()

    def is_here(self) -> None:
        """The running loop is the one."""
        self._real = asyncio.get_running_loop()

    @property
    def running(self) -> bool:
        """True on its own thread."""
        return self._real is not None and asyncio._get_running_loop() is self._real

    def call_soon_threadsafe(self, call: Callable[..., object], *args: Any) -> None:
        """Called by the loop at its next turn."""
        if self._real is None or (not args and call in self._due):
            return
        self._due.add(call)
        try:
            self._real.call_soon_threadsafe(self._call, call, *args)
        except RuntimeError:  # it has ended, and everybody who looked with it
            self._due.discard(call)

    def create_task(self, work: Coroutine[Any, Any, Any], **named: Any) -> asyncio.Task[Any]:
        """Done by the loop; on its own thread."""
        return asyncio.get_running_loop().create_task(work, **named)

    def _call(self, call: Callable[..., object], *args: Any) -> None:
        self._due.discard(call)
        call(*args)


class _Told(asyncio.Event):
    """viser sets its events from any thread and asks the loop to set them, too: the second alone wakes who waits
    without another thread's hand in the loop's own lists."""

    def __init__(self, loop: PagesLoop):
        super().__init__()
        self._pages = loop

    def set(self) -> None:
        if self._pages.running:
            super().set()


class Pages(WebsockServer):
    """viser's server without a port: `show` is what its handler of a connection was."""

    def start(self) -> None:
        """There is nothing to start; what is drawn is kept for whoever comes."""
        self._loop = PagesLoop()
        self._broadcast_buffer = self._buffer(persistent=True)
        self._numbers = itertools.count()

    def stop(self) -> None:
        """Whoever looks has seen the last of it."""
        self._broadcast_buffer.set_done()
        for state in list(self._client_state_from_id.values()):
            state.message_buffer.set_done()

    async def show(self, page: Frames) -> None:
        """All of the scene and what changes, and what the page says of it, until the scene or the page ends.

        Raises:
            Exception: what `page` raised.
        """
        self._loop.is_here()
        number, own = viser_infra.ClientId(next(self._numbers)), self._buffer(persistent=False)
        loop: Any = self._loop
        client = viser_infra.WebsockClientConnection(number, viser_infra._ClientHandleState(own, loop))
        self._client_state_from_id[number] = client._state
        try:
            await _called(self._client_connect_cb, client)
            socket: Any = page
            await _first(
                viser_infra._message_producer(socket, own, number),
                viser_infra._message_producer(
                    socket, self._broadcast_buffer, number, self._backlog_done_message
                ),
                self._hear(page, client),
            )
        finally:
            own.set_done()
            del self._client_state_from_id[number]
            self._broadcast_buffer.generator_cursors.pop(number, None)
            await _called(self._client_disconnect_cb, client)

    async def _hear(self, page: Frames, client: viser_infra.WebsockClientConnection) -> None:
        number: Any = client.client_id
        while True:
            said = await page.recv()
            try:
                message = self._message_class.deserialize(said)
                await self._handle_incoming_message(number, message)
                await client._handle_incoming_message(number, message)
            except Exception:  # no client of viser's says such a thing
                return

    def _buffer(self, *, persistent: bool) -> AsyncMessageBuffer:
        loop: Any = self._loop
        return AsyncMessageBuffer(
            loop, persistent, message_event=_Told(self._loop), flush_event=_Told(self._loop)
        )


async def _called(calls: list[Callable[[Any], Any]], client: viser_infra.WebsockClientConnection) -> None:
    for call in calls:
        waited = call(client)
        if asyncio.iscoroutine(waited):
            await waited


async def _first(*works: Coroutine[Any, Any, None]) -> None:
    """Until one ends; raises what ended it."""
    tasks = [asyncio.ensure_future(work) for work in works]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        for task in (await asyncio.wait(tasks))[0]:
            _ = task.cancelled() or task.exception()
    for task in done:
        task.result()
