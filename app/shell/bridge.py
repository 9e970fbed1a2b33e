"""The scene's page and its socket under our own address."""

from __future__ import annotations

import contextlib
import gzip
import hashlib
from functools import cache

from starlette.requests import Request
from starlette.responses import Response
from starlette.websockets import WebSocket, WebSocketDisconnect

from app.shell.security import HEADERS, SCENE_POLICY
from app.workers.live import Live
from app.workers.looking_on import for_onlooker

_OTHER_VERSION, _GONE = 1002, 1001  # codes with which the scene's socket is closed
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
    """A session's scene for its page, until either ends."""
    await _shown(page, live, _Both(page))


async def watch_scene(page: WebSocket, live: Live, *, dark: bool) -> None:
    """A session's scene for somebody who looks on, on a dark page or a light one; what his page says gets nowhere."""
    await _shown(page, live, _Down(page, dark))


class _Both:
    """Frames as they are, both ways."""

    def __init__(self, page: WebSocket):
        self._page = page

    async def send(self, frame: bytes, /) -> None:
        await self._page.send_bytes(frame)

    async def recv(self) -> bytes:
        return await self._page.receive_bytes()


class _Down(_Both):
    """Frames for somebody who looks on, to the page alone."""

    def __init__(self, page: WebSocket, dark: bool):
        super().__init__(page)
        self._dark = dark

    async def send(self, frame: bytes, /) -> None:
        await super().send(for_onlooker(frame, dark=self._dark))

    async def recv(self) -> bytes:
        while True:
            await super().recv()


async def _shown(page: WebSocket, live: Live, frames: _Both) -> None:
    if live.scene_protocol not in page.scope["subprotocols"]:  # a page of another version: it is loaded anew
        await page.close(_OTHER_VERSION)
        return
    await page.accept(subprotocol=live.scene_protocol)
    with contextlib.suppress(WebSocketDisconnect, RuntimeError, KeyError):  # gone, as pages go
        await live.show(frames)
    with contextlib.suppress(RuntimeError, WebSocketDisconnect):  # the page may have closed first
        await page.close(_GONE)
