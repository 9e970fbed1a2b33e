"""A page without a screen, and the pendant in a process of its own, for the pendant's benchmarks."""

from __future__ import annotations

import asyncio
import json
import multiprocessing
import os
import tempfile
import time
from importlib.metadata import version
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from websockets.asyncio.client import ClientConnection, connect

ROBOT = "ur10e"
BEAT_S = 0.033  # as the page says what is held
_PAGE = os.sysconf("SC_PAGE_SIZE")
_TICKS = os.sysconf("SC_CLK_TCK")


class Served:
    """The pendant in a process of its own."""

    def __enter__(self) -> Served:
        ours, theirs = multiprocessing.Pipe()
        self._folder = tempfile.TemporaryDirectory()
        context = multiprocessing.get_context("spawn")
        self._process = context.Process(target=_serve, args=(self._folder.name, theirs), daemon=True)
        self._process.start()
        self.port = ours.recv()
        self._ours = ours
        return self

    def __exit__(self, *_: object) -> None:
        self._ours.send("stop")
        self._process.join(timeout=20.0)
        self._folder.cleanup()

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    def processor(self) -> float:
        """Seconds of processor used so far."""
        return processor_of(self._process.pid or 0)

    def memory(self) -> float:
        """Bytes in memory."""
        return int(Path(f"/proc/{self._process.pid}/statm").read_text(encoding="ascii").split()[1]) * _PAGE


def processor_of(pid: int) -> float:
    """Seconds of processor a process has used so far."""
    stat = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(stat[11]) + int(stat[12])) / _TICKS


def _serve(folder: str, pipe: Connection) -> None:
    from app.session import Store
    from app.shell.server import PendantServer

    server = PendantServer(Store(Path(folder)), port=0, robot=ROBOT, linger=1.0)
    pipe.send(server.port)
    pipe.recv()
    server.stop()


class Page:
    """One page: its two sockets, what is held, and the figures heard last."""

    def __init__(self, words: ClientConnection, scene: ClientConnection, cookie: str):
        self._words, self._scene, self.cookie = words, scene, cookie
        self.read: dict[str, Any] = {}
        self.way = 0.0  # degrees (mm) that axis 1 went, there and back
        self.moved = asyncio.Event()
        self.pongs: dict[float, float] = {}
        self.gone = asyncio.Event()
        self._widgets: dict[int, dict[str, Any]] = {}
        self._tasks = [asyncio.create_task(self._listen()), asyncio.create_task(self._watch())]
        self._press = 0

    async def say(self, **message: Any) -> None:
        await self._words.send(json.dumps(message))

    async def hold(self, seconds: float, axis: int, sign: int) -> None:
        """The switch and a button, for so long; then let go."""
        self._press += 1
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            await self.say(t="beat", en=True, axis=axis, sign=sign, press=self._press)
            await asyncio.sleep(BEAT_S)
        await self.say(t="beat", en=False)

    def rows(self) -> dict[str, bool]:
        """Row of the list -> done or not."""
        found = next((w for w in self._widgets.values() if w["kind"] == "rows"), {})
        return {row["key"]: row.get("state") == "done" for row in found.get("rows", ())}

    async def press_row(self, row: str, action: str) -> None:
        """A button in a row of the list."""
        number = next(n for n, w in self._widgets.items() if w["kind"] == "rows")
        await self.say(t="press", id=number, value=f"{row}/{action}")

    async def close(self) -> None:
        for task in self._tasks:
            task.cancel()
        await self._words.close()
        await self._scene.close()

    async def _listen(self) -> None:
        try:
            async for text in self._words:
                self._take(json.loads(text))
        finally:
            self.gone.set()

    def _take(self, message: dict[str, Any]) -> None:
        if message["t"] == "read":
            if self.read and self.read["axes"] != message["axes"]:
                self.way += abs(message["axes"][0]["number"] - self.read["axes"][0]["number"])
                self.moved.set()
            self.read = message
        elif message["t"] == "pong":
            self.pongs[message["n"]] = time.perf_counter()
        elif message["t"] == "panel":
            if message["whole"]:
                self._widgets = {}
            for number in message["removed"]:
                self._widgets.pop(number, None)
            self._widgets |= {w["id"]: w for w in message["widgets"]}

    async def _watch(self) -> None:
        async for _ in self._scene:
            pass


async def _cookie(port: int, cookie: str) -> str:
    """Asks for the page, on the loop: threads of a pool would let six people in at a time, however fast the server is.
    Raises ConnectionResetError where it is not given."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        with_cookie = f"Cookie: {cookie}\r\n" if cookie else ""
        writer.write(
            f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n{with_cookie}Connection: close\r\n\r\n".encode()
        )
        head, _, _ = (await reader.read()).decode("utf-8", "replace").partition("\r\n\r\n")
    finally:
        writer.close()
    first, *lines = head.split("\r\n")
    given = [line.partition(":")[2].strip() for line in lines if line.lower().startswith("set-cookie:")]
    if " 200 " not in f"{first} " or not given:
        raise ConnectionResetError(first)
    return given[0].partition(";")[0]


async def enter(served: Any, cookie: str = "") -> Page:
    """A page that has come up; raises ConnectionResetError where the server ends before."""
    cookie = await _cookie(served.port, cookie)
    address = f"ws://127.0.0.1:{served.port}"
    named: Any = {
        "origin": served.address,
        "additional_headers": {"Cookie": cookie},
        "max_size": None,
        "open_timeout": None,
    }
    words = await connect(f"{address}/words", **named)
    protocol: Any = f"viser-v{version('viser')}"
    scene = await connect(f"{address}/scene", subprotocols=[protocol], compression=None, **named)
    page = Page(words, scene, cookie)
    while not page.read:
        if page.gone.is_set():
            raise ConnectionResetError
        await asyncio.sleep(0.02)
    return page
