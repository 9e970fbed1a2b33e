"""The front of several workers: takes browsers in, ends their TLS, and hands each to the worker that has his session.

One request a connection, bytes unchanged but for the head: what a browser says of its own address is replaced by what
is seen here. The worker is remembered by the cookie, as a proxy's stick table does; where a browser's worker is gone,
another takes it, and the session with it.
"""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import re
import ssl
import time
from collections.abc import Callable
from http.cookies import CookieError, SimpleCookie
from pathlib import Path

from app.shell.elsewhere import MAY_BE, process_said
from app.shell.floods import STATUS, WORDS, Flow
from app.shell.security import COOKIE
from app.shell.spread import Known, Spread

LARGEST_HEAD = 65536  # bytes of a request's or answer's head
_SLOW = 15.0  # seconds a browser has to say what it wants
_WAIT = 5.0  # seconds a browser waits for a worker
_LOOK = 0.1  # seconds between two tries
_PIECE = 65536
#: Said anew here: who forwards, and for whom.
_OURS = (b"x-forwarded-for", b"x-forwarded-proto", b"forwarded")
#: Between the front and its workers alone, whoever says it.
_OWN = (MAY_BE.partition(b":")[0].lower(),)
#: Of one connection: it ends with its request.
_HOP = (b"connection", b"keep-alive", b"proxy-connection")
_SET = re.compile(rb"^set-cookie:\s*" + COOKIE.encode() + rb"=([^;\r\n]+)", re.IGNORECASE | re.MULTILINE)
_FIRST = re.compile(rb"[A-Z]{1,20} [!-~]+ HTTP/1\.[01]\Z")
_LATER = (
    b"HTTP/1.1 503 Service Unavailable\r\nRetry-After: 2\r\nContent-Type: text/html; charset=utf-8\r\n"
    b"Cache-Control: no-store\r\nConnection: close\r\nRefresh: 2\r\n\r\n"
    b"<!doctype html><p>The pendant is starting again; this page comes back by itself."
    b"<p lang=zh>\xe7\xa4\xba\xe6\x95\x99\xe5\x99\xa8\xe6\xad\xa3\xe5\x9c\xa8\xe9\x87\x8d\xe6\x96\xb0\xe5\x90\xaf"
    b"\xe5\x8a\xa8\xef\xbc\x8c\xe6\x9c\xac\xe9\xa1\xb5\xe4\xbc\x9a\xe8\x87\xaa\xe8\xa1\x8c\xe6\x81\xa2\xe5\xa4\x8d\xe3\x80\x82\n"
)
_TOO_MANY = (
    f"HTTP/1.1 {STATUS} Too Many Requests\r\nRetry-After: 5\r\nContent-Type: text/plain; charset=utf-8\r\n"
    f"Cache-Control: no-store\r\nConnection: close\r\n\r\n{WORDS}"
).encode()
_BAD = b"HTTP/1.1 400 Bad Request\r\nConnection: close\r\nContent-Length: 0\r\n\r\n"


class Front:
    """Hands connections to workers.

    Args:
        sockets: where each worker listens.
        ready: tells whether a worker runs.
        number: of the worker that a process is; None for another one.
        trusted: tells of an address whether a proxy stands there whose word on browsers is taken.
        secure: True where browsers come by TLS.
        flow: counts requests, for all workers together; None where nobody is counted.
    """

    def __init__(
        self,
        sockets: list[Path],
        ready: Callable[[int], bool],
        number: Callable[[int], int | None],
        trusted: Callable[[str], bool],
        *,
        secure: bool,
        flow: Flow | None = None,
    ):
        self._flow = flow
        self._sockets, self._ready, self._number = sockets, ready, number
        self._trusted, self._secure = trusted, secure
        self.spread = Spread(len(sockets), ready)

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """One browser's connection, to its end."""
        gone = (OSError, ssl.SSLError, asyncio.IncompleteReadError, TimeoutError)
        try:
            with contextlib.suppress(*gone):
                await self._through(reader, writer)
        finally:
            writer.close()
            with contextlib.suppress(*gone):
                await asyncio.wait_for(writer.wait_closed(), _WAIT)

    async def _through(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            head = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), _SLOW)
            asked = _Asked(head)
        except (ValueError, asyncio.LimitOverrunError):
            writer.write(_BAD)
            await writer.drain()
            return
        peer = str(writer.get_extra_info("peername")[0])
        address = None if self._trusted(peer) else peer
        if self._flow is not None and not self._flow.fits(asked.cookie, address or asked.forwarded() or peer):
            writer.write(_TOO_MANY)
            await writer.drain()
            return
        known = self.spread.find(asked.key)
        if known is not None:
            known.open += 1
        try:
            found = await self._worker(known)
            if found is None:
                writer.write(_LATER)
                await writer.drain()
                return
            number, streams = found
            try:
                head = asked.head(address, secure=self._secure)
                process = await self._ask(head, number, reader, writer, streams)
            finally:
                if known is None:
                    self.spread.stranger(number, -1)
            other = None if process is None else self._number(process)
            if other is not None:
                streams = await asyncio.open_unix_connection(str(self._sockets[other]), limit=LARGEST_HEAD)
                again = asked.head(address, secure=self._secure, again=True)
                await self._ask(again, other, reader, writer, streams)
        finally:
            if known is not None:
                known.open, known.last = known.open - 1, time.monotonic()

    async def _ask(self, head: bytes, number: int, reader, writer, streams) -> int | None:
        """A request at a worker, to its end; the process that has what it asks for, where that is another one."""
        of, to = streams
        try:
            to.write(head)
            await to.drain()
            return await self._answer(number, reader, writer, of, to)
        finally:
            to.close()

    async def _answer(self, number: int, reader, writer, of, to) -> int | None:
        up = asyncio.create_task(_copy(reader, to))
        try:
            head = await _first(of.readuntil(b"\r\n\r\n"), up)
            if head is None:
                return None
            process = process_said(head)
            if process is not None:
                return process
            given = _SET.search(head)
            if given is not None:
                self.spread.remember(_key(given[1].strip(b'"').decode("latin-1")), number)
            writer.write(head)
            await _first(_copy(of, writer), up)
            return None
        finally:
            up.cancel()
            await asyncio.gather(up, return_exceptions=True)

    async def _worker(self, known: Known | None):
        """A worker's streams: the browser's own, else another, while there is time; None where none comes."""
        end = time.monotonic() + _WAIT
        refused: set[int] = set()
        while True:
            if (
                not self.spread.ready
            ):  # it starts: nobody is given to a worker that may not be the first to come
                if time.monotonic() > end:
                    return None
                await asyncio.sleep(_LOOK)
                continue
            number = self.spread.worker(known, refused)
            if known is None:
                self.spread.stranger(number)
            try:
                streams = await asyncio.open_unix_connection(str(self._sockets[number]), limit=LARGEST_HEAD)
            except BaseException as error:
                if known is None:
                    self.spread.stranger(number, -1)
                if not isinstance(error, OSError):
                    raise
                refused.add(number)
                if len(refused) == len(self._sockets):
                    refused.clear()
                if time.monotonic() > end:
                    return None
                await asyncio.sleep(_LOOK)
                continue
            return number, streams


class _Asked:
    """A request's head; raises ValueError where it is none."""

    def __init__(self, head: bytes):
        first, *lines = head[:-4].split(b"\r\n")
        if not _FIRST.match(first) or b"\n" in head.replace(b"\r\n", b"") or b"\0" in head:
            raise ValueError("no request")
        self._first, self._fields = first, []
        for line in lines:
            name, mark, value = line.partition(b":")
            if not mark or not name or name != name.strip():
                raise ValueError("no header")
            self._fields.append((name.lower(), line, value.strip()))
        upgrades = [value.lower() for name, _, value in self._fields if name == b"upgrade"]
        self.socket = upgrades == [b"websocket"]
        self.cookie = self._cookie()
        self.key = _key(self.cookie)

    def head(self, address: str | None, *, secure: bool, again: bool = False) -> bytes:
        """What the worker is told; `address` is the browser's, None where a proxy has said it; `again` where another
        worker has sent it on."""
        drop = (*_HOP, *_OWN, *(() if address is None else _OURS))
        lines = [self._first, *(line for name, line, _ in self._fields if name not in drop)]
        if address is not None:
            lines += [b"X-Forwarded-For: " + address.encode(), b"X-Forwarded-Proto: http" + b"s" * secure]
        if self.socket and not again:
            lines.append(MAY_BE)
        lines.append(b"Connection: Upgrade" if self.socket else b"Connection: close")
        return b"\r\n".join(lines) + b"\r\n\r\n"

    def forwarded(self) -> str:
        """The browser's address as a proxy says it, and as the worker believes it; empty where it does not."""
        said = next((value for name, _, value in self._fields if name == b"x-forwarded-for"), b"")
        return said.partition(b",")[0].strip().decode("latin-1")

    def _cookie(self) -> str:
        for name, _, value in self._fields:
            if name == b"cookie":
                try:
                    found = SimpleCookie(value.decode("latin-1")).get(COOKIE)
                except CookieError:
                    continue
                if found is not None:
                    return found.value
        return ""


def _key(cookie: str) -> str:
    """What a browser is remembered by: no secret."""
    return hashlib.sha256(cookie.encode("latin-1", "replace")).hexdigest() if cookie else ""


async def _copy(of: asyncio.StreamReader, to: asyncio.StreamWriter) -> None:
    while piece := await of.read(_PIECE):
        to.write(piece)
        await to.drain()


async def _first(work, other: asyncio.Task[None]):
    """What `work` gives; None where the other side ended first."""
    task = asyncio.ensure_future(work)
    try:
        await asyncio.wait({task, other}, return_when=asyncio.FIRST_COMPLETED)
        return task.result() if task.done() else None
    finally:
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
