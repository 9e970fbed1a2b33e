"""Who may speak to this server: the addresses it serves, pages of its own, browsers that hold a secret.

A page from elsewhere that a trainee visits could open a socket to this machine. So every request is looked at first:
its Host must be one that is served, and whatever changes something or opens a socket must come from a page of ours.
"""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from urllib.parse import urlsplit

from starlette.requests import HTTPConnection
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send

COOKIE = "teachframe"
LOOK_COOKIE = "teachframe_look"
FORM_COOKIE = "teachframe_form"
_SAFE = ("GET", "HEAD")
_LOCAL = frozenset({"localhost", "127.0.0.1", "::1"})

#: Headers of every answer.
HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",  # not no-referrer: forms of our own would then come with the origin "null"
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}
#: Our own page: scripts and pictures of our own alone; styles also inline, for the pictures of a diagnosis.
PAGE_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
    "connect-src 'self'; frame-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'self'"
)
#: The scene's page: viser's client brings its scripts inline, and workers as blobs; no eval.
SCENE_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob: data:; worker-src blob: data:; "
    "style-src 'unsafe-inline'; img-src 'self' data: blob:; font-src data:; connect-src 'self' data: blob:; "
    "frame-ancestors 'self'; base-uri 'none'; form-action 'none'"
)


class Doors:
    """Looks at Host and Origin before anything else does.

    Args:
        app: what is behind the doors.
        host: the address that is served; 0.0.0.0 and :: are every address of this machine.
        names: further host names that are answered.
    """

    def __init__(self, app: ASGIApp, host: str, names: tuple[str, ...] = ()):
        self._app = app
        self._names = _LOCAL | {host.lower(), *(name.lower() for name in names)}
        self._any_address = host in ("0.0.0.0", "::", "")

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One connection."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        asked = HTTPConnection(scope)
        if not self.known(asked.headers.get("host", "")):
            await refuse(scope, receive, send, 421, "this address is not served here")
            return
        changes = scope["type"] == "websocket" or scope["method"] not in _SAFE
        if changes and not same_origin(asked.headers, safe=asked.url.scheme in ("https", "wss")):
            await refuse(scope, receive, send, 403, "only pages of this server may do that")
            return
        await self._app(scope, receive, send)

    def known(self, host: str) -> bool:
        """True where a Host header names an address that is served."""
        try:
            name = (urlsplit(f"//{host}").hostname or "").lower()
        except ValueError:
            return False
        if name in self._names:
            return True
        return self._any_address and _is_address(name)


def same_origin(headers: Mapping[str, str], *, safe: bool = False) -> bool:
    """True where the page that asks was served under the very address it asks; `safe` where that is over TLS."""
    origin, host = headers.get("origin", ""), headers.get("host", "")
    try:
        parts = urlsplit(origin)
    except ValueError:
        return False
    return (
        bool(host)
        and parts.scheme in (("https",) if safe else ("http", "https"))
        and parts.netloc.lower() == host.lower()
    )


def _is_address(name: str) -> bool:
    """A number, not a name: a name could be pointed at this machine by whoever owns it."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


async def refuse(scope: Scope, receive: Receive, send: Send, status: int, words: str) -> None:
    """Says no to a request or, before it is accepted, to a socket."""
    if scope["type"] == "websocket":
        await receive()
        if "websocket.http.response" in scope.get("extensions", {}):
            answer = {"type": "websocket.http.response.start", "status": status, "headers": []}
            await send(answer)
            await send({"type": "websocket.http.response.body", "body": words.encode()})
        else:
            await send({"type": "websocket.close", "code": 1008, "reason": words})
        return
    await PlainTextResponse(words, status_code=status, headers=HEADERS)(scope, receive, send)
