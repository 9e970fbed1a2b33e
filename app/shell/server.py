"""The pendant's web server: routes, start and stop."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import gc
import socket
import threading
import time
from collections.abc import AsyncIterator, Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import uvicorn
from starlette.applications import Starlette
from starlette.requests import HTTPConnection, Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp
from starlette.websockets import WebSocket

from app.errors import TeachframeError
from app.people import People
from app.people.tries import Tries
from app.session import Store
from app.shell.account import Account
from app.shell.bridge import scene_page, scene_socket
from app.shell.classroom import class_pages
from app.shell.coming_in import ComingIn, to_login
from app.shell.entrance import Entrance, Visitor
from app.shell.files import Drops, download
from app.shell.floods import Floods, Flow
from app.shell.listening import address_of, listen_at
from app.shell.not_here import not_here
from app.shell.outside import LOGIN, Outside
from app.shell.provider import Provider
from app.shell.security import HEADERS, LOOK_COOKIE, PAGE_POLICY, Doors
from app.shell.unavailable import unavailable
from app.shell.way import Way
from app.shell.wire import Sockets, Wire
from app.shell.words import NOT_KNOWN, Words
from app.workers.hub import LINGER, Hub
from app.workers.live import Live

PAGES = Path(__file__).parent / "pages"
_AGAIN = 1013  # code with which a socket is closed whose page may try again in a moment
#: Sessions that are opened at once; who is waited for by a lease or a disk keeps so many of the others waiting.
_OPENING = 8
_STARTING = 20.0  # seconds a server has to come up


class Shell:
    """The routes of one server.

    Args:
        hub: all sessions.
        host: the address that is served.
        names: further host names that are answered.
        people: the accounts; None lets in browsers of this machine without any.
        prefix: path under which all of it stands, such as /teachframe, for a proxy; empty for none.
        provider: who vouches for people besides their passwords here.
        fronted: True where a front stands before this process and counts requests for all of them.
    """

    def __init__(
        self,
        hub: Hub,
        host: str,
        names: tuple[str, ...] = (),
        *,
        people: People | None = None,
        prefix: str = "",
        provider: Provider | None = None,
        fronted: bool = False,
    ):
        self.hub, self._drops = hub, Drops(Tries(hub.store.database))
        self._entrance, self._opening = Entrance(people), ThreadPoolExecutor(_OPENING, "opening")
        routes: list[BaseRoute] = [
            Route("/", self._home),
            Route("/state", self._state),
            Route("/scene/", self._scene),
            Route("/upload/{widget:int}/{drop}", self._upload, methods=["PUT"]),
            Route("/download/{token}", self._download),
            WebSocketRoute("/scene", self._scene_socket),
            WebSocketRoute("/words", self._words),
            Mount("/static", _Static(directory=PAGES)),
        ]
        if people is not None:
            coming_in = ComingIn(self._entrance, people, (LOGIN, provider.name) if provider else None)
            routes += coming_in.routes
            if provider is not None:
                routes += Outside(self._entrance, people, provider, coming_in).routes
            routes += Account(self._entrance, people, hub.leave).routes
            routes += class_pages(self._entrance, hub)
            hub.attending.start()
        self._routes = list(routes)
        if prefix:
            routes = [Mount(prefix, routes=routes)]
        handlers = {**_HANDLERS, 404: not_here(prefix)}
        inner = Starlette(routes=routes, lifespan=self._life, exception_handlers=handlers)
        flow = None if people is None or fronted else Flow(self._entrance.key)
        self.app: ASGIApp = Doors(Floods(inner, flow), host, names)

    @contextlib.asynccontextmanager
    async def _life(self, _: Starlette) -> AsyncIterator[None]:
        yield
        await asyncio.to_thread(self.hub.close)
        self._opening.shutdown(wait=False)
        self._drops.close()

    async def _home(self, request: Request) -> Response:
        """The page. Without accounts, who comes without a secret gets one; with accounts he logs in first."""
        visitor = await self._entrance.let(request, "work")
        if visitor is None:
            if self._entrance.people is not None:
                return to_login(request)
            visitor = self._entrance.newcomer()
        await self._enter(request, visitor)
        page = (PAGES / "index.html").read_bytes()
        headers = {**HEADERS, "Content-Security-Policy": PAGE_POLICY, "Cache-Control": "no-store"}
        answer = Response(page, media_type="text/html", headers=headers)
        self._entrance.give(answer, request, visitor.secret)
        return answer

    async def _state(self, request: Request) -> Response:
        """Everything on the page as JSON: the frame's figures and every widget."""
        live = await self._known(request, "work")
        if live is None:
            return PlainTextResponse("no session here", 401, HEADERS)
        import msgspec

        state = {"read": live.read(), "widgets": live.context.ui.widgets()}
        return Response(msgspec.json.encode(state), media_type="application/json", headers=HEADERS)

    async def _scene(self, request: Request) -> Response:
        live = await self._known(request, "work")
        return PlainTextResponse("", 401, HEADERS) if live is None else scene_page(request)

    async def _upload(self, request: Request) -> Response:
        live, visitor = await self._known(request, "upload"), await self._entrance.who(request)
        if live is None or visitor is None:
            return JSONResponse(None, 401, HEADERS)
        return await self._drops.take(request, live, visitor.owner)

    async def _download(self, request: Request) -> Response:
        live = await self._known(request, "download")
        if live is None:
            return PlainTextResponse("", 401, HEADERS)
        return download(request.path_params["token"], live)

    async def _scene_socket(self, page: WebSocket) -> None:
        live = await self._known(page, "work")
        await (page.close(NOT_KNOWN) if live is None else scene_socket(page, live))

    async def _words(self, page: WebSocket) -> None:
        visitor = await self._entrance.let(page, "work")
        if visitor is None:
            await page.close(NOT_KNOWN)
            return
        live = await self._enter(page, visitor)
        await Words(page, live, self.hub, self._entrance, visitor).run()

    async def _enter(self, asked: HTTPConnection, visitor: Visitor) -> Live:
        # On threads for this alone: whoever asks for something else waits for none of them.
        live = self.hub.find(visitor.owner)
        if live is not None:
            return live
        look = asked.cookies.get(LOOK_COOKIE)
        enter = functools.partial(self.hub.enter, visitor.owner, look, visitor.person)
        return await asyncio.get_running_loop().run_in_executor(self._opening, enter)

    async def _known(self, asked: HTTPConnection, deed: str) -> Live | None:
        visitor = await self._entrance.let(asked, deed)
        return None if visitor is None else self.hub.find(visitor.owner)


async def _later(asked: Request | WebSocket, error: Exception) -> Response | None:
    """A full disk, a locked database: it may be gone in a moment."""
    assert isinstance(error, TeachframeError)
    if isinstance(asked, WebSocket):
        await asked.close(_AGAIN)
        return None
    return unavailable(error)


_HANDLERS: Mapping[Any, Any] = {TeachframeError: _later}


class _Static(StaticFiles):
    """Files of the page; asked for anew each time, answered with 304 where they are the same."""

    def file_response(self, *args: Any, **named: Any) -> Response:
        answer = super().file_response(*args, **named)
        answer.headers.update({**HEADERS, "Cache-Control": "no-cache"})
        return answer


class PendantServer:
    """Serves the pendant until it is stopped, on a thread of its own.

    Args:
        store: where sessions are kept.
        host, port: where to listen; port 0 takes any free one, a port that is taken the next free one.
        people: the accounts; None lets in browsers of this machine without any.
        way: names, prefix, certificate: how browsers come to it.
        provider: who vouches for people besides their passwords here.
        listening: a socket of this machine alone instead of host and port: a front's, which says whom it speaks for.
        hub: arguments of the hub: robot, usual_world, linger.
    """

    def __init__(
        self,
        store: Store,
        *,
        host: str = "127.0.0.1",
        port: int = 8080,
        people: People | None = None,
        way: Way | None = None,
        provider: Provider | None = None,
        listening: socket.socket | None = None,
        **hub: Any,
    ):
        way = way or Way()
        self.hub = Hub(store, **{"unvisited": LINGER, **hub})
        self._host, self._way = host, way
        self._socket = listening or listen_at(host, port)
        self.port: int = port if listening else self._socket.getsockname()[1]
        shell = Shell(
            self.hub,
            host,
            way.names,
            people=people,
            prefix=way.prefix,
            provider=provider,
            fronted=listening is not None,
        )
        config = uvicorn.Config(
            shell.app,
            log_level="warning",
            access_log=False,
            http=Wire,
            ws=Sockets,
            ws_max_size=1 << 20,
            ws_per_message_deflate=False,  # packing a scene for twenty pages took longer than sending it
            ws_ping_interval=20.0,
            server_header=False,
            timeout_graceful_shutdown=2,
            ssl_certfile=way.certificate,
            ssl_keyfile=way.key,
            proxy_headers=way.proxy,
            forwarded_allow_ips="*" if listening else None,
        )
        self._server = uvicorn.Server(config)
        self._thread = threading.Thread(
            target=lambda: self._server.run(sockets=[self._socket]), name="pendant-server", daemon=True
        )
        self._thread.start()
        _until(lambda: self._server.started or not self._thread.is_alive())

    @property
    def address(self) -> str:
        """What to open in a browser."""
        return address_of(self._host, self.port, self._way)

    @property
    def lives(self) -> list[Live]:
        """All open sessions."""
        return self.hub.lives

    @property
    def running(self) -> bool:
        """False once it has ended."""
        return self._thread.is_alive()

    def wait(self) -> None:
        """Serves until somebody interrupts; what is loaded so far is no longer looked through for garbage, since that
        keeps every page waiting for a twentieth of a second."""
        gc.freeze()  # without collecting: a signal to end that comes in the midst of that is lost
        while self._thread.is_alive():
            self._thread.join(timeout=3600.0)

    def stop(self) -> None:
        """Closes every session and stops listening."""
        self._server.should_exit = True
        self._thread.join(timeout=_STARTING)
        self.hub.close()
        self._socket.close()


def _until(true: Callable[[], bool]) -> None:
    end = time.monotonic() + _STARTING
    while not true() and time.monotonic() < end:
        time.sleep(0.005)
