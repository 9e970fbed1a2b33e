"""The scene's page and its socket under our own address: frames go through unchanged."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import hashlib
from collections.abc import Awaitable, Callable
from functools import cache

from starlette.requests import Request
from starlette.responses import Response
from starlette.websockets import WebSocket, WebSocketDisconnect
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake

from app.shell.security import HEADERS, SCENE_POLICY
from app.workers.live import Live
from app.workers.looking_on import without_handle

#: What is done with what a page says.
Up = Callable[[WebSocket, ClientConnection], Awaitable[None]]
_LARGEST = 50 << 20  # bytes of one frame, as viser has it
#: The only thing a page may ask of the scene: a resolution that software can draw. `?websocket=` would point it away.
_MAY_ASK = frozenset({"fixedDpr"})


@cache
def _page() -> tuple[bytes, bytes, str]:
    plain = Live.scene_page()
    return plain, gzip.compress(plain), f'"{hashlib.sha256(plain).hexdigest()[:16]}"'


def scene_page(request: Request) -> Response:
    """The scene's client, for the frame in our page."""
    if request.headers.get("sec-fetch-dest") == "document":
        return Response(status_code=303, headers={"Location": "../"})
    if set(request.query_params) - _MAY_ASK:
        return Response(status_code=400)
    plain, packed, tag = _page()
    headers = {
        **HEADERS,
        "Content-Security-Policy": SCENE_POLICY,
        "X-Frame-Options": "SAMEORIGIN",
        "Cache-Control": "no-cache",
        "ETag": tag,
        "Vary": "Accept-Encoding",
    }
    if request.headers.get("if-none-match") == tag:
        return Response(status_code=304, headers=headers)
    if "gzip" in request.headers.get("accept-encoding", ""):
        return Response(packed, media_type="text/html", headers={**headers, "Content-Encoding": "gzip"})
    return Response(plain, media_type="text/html", headers=headers)


async def scene_socket(page: WebSocket, live: Live) -> None:
    """Frames both ways until either side is gone; awaiting each send is the back-pressure."""
    await _bridged(page, live, _up, lambda frame: frame)


async def watch_scene(page: WebSocket, live: Live) -> None:
    """Frames of a session's scene for somebody who looks on; of what his page says, nothing gets there."""
    await _bridged(page, live, _nowhere, without_handle)


async def _bridged(page: WebSocket, live: Live, up: Up, seen: Callable[[bytes], bytes]) -> None:
    try:
        scene = await connect(
            f"ws://127.0.0.1:{live.scene_port}",
            subprotocols=page.scope["subprotocols"],
            compression=None,
            max_size=_LARGEST,
            origin=live.scene_origin,  # type: ignore[arg-type]
            user_agent_header=None,
            ping_interval=None,
        )
    except (OSError, InvalidHandshake):
        await page.close(1013)
        return
    async with scene:
        await page.accept(subprotocol=scene.subprotocol)
        await _both(lambda: up(page, scene), lambda: _down(page, scene, seen))
    with contextlib.suppress(RuntimeError, WebSocketDisconnect):  # the page may have closed first
        await page.close(scene.close_code or 1001)


async def _up(page: WebSocket, scene: ClientConnection) -> None:
    while True:
        await scene.send(await page.receive_bytes())


async def _nowhere(page: WebSocket, scene: ClientConnection) -> None:
    while True:
        await page.receive_bytes()


async def _down(page: WebSocket, scene: ClientConnection, seen: Callable[[bytes], bytes]) -> None:
    async for frame in scene:
        await page.send_bytes(seen(frame if isinstance(frame, bytes) else frame.encode()))


async def _both(*ways: Callable[[], Awaitable[None]]) -> None:
    """Runs until one ends; why it ended is of no interest: the other side is told by closing."""
    tasks = [asyncio.ensure_future(way()) for way in ways]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        for outcome in await asyncio.gather(*tasks, return_exceptions=True):
            known = (WebSocketDisconnect, ConnectionClosed, asyncio.CancelledError, RuntimeError, KeyError)
            if isinstance(outcome, BaseException) and not isinstance(outcome, known):
                raise outcome
