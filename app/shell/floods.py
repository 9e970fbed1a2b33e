"""Who asks more than a page ever does waits: others must not. Looked at before anything that costs time."""

from __future__ import annotations

from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Receive, Scope, Send

from app.people.limits import REQUESTS, REQUESTS_OF_ADDRESS
from app.people.meter import Meter
from app.shell.security import COOKIE, refuse
from app.shell.signing import secret_of

#: What is said to who asks too much, and the status it is said with.
STATUS, WORDS = 429, "too many requests; wait a few seconds"


class Flow:
    """Counts requests of one server: by the front where it has one, so that all its processes count together.

    Args:
        key: that log-ins are signed with.
    """

    def __init__(self, key: bytes):
        self._key = key
        self._known, self._strange = Meter(REQUESTS), Meter(REQUESTS_OF_ADDRESS)

    def fits(self, cookie: str, address: str) -> bool:
        """Counts a request: of a browser that holds a signed cookie by that, of any other by its address."""
        secret = secret_of(self._key, cookie)
        return self._strange.count(address) if secret is None else self._known.count(secret)


class Floods:
    """Turns away what does not fit.

    Args:
        app: what is behind.
        flow: counts; None where nothing is counted here: without accounts, or behind a front that counts.
    """

    def __init__(self, app: ASGIApp, flow: Flow | None):
        self._app, self.flow = app, flow

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One connection."""
        if scope["type"] in ("http", "websocket") and self.flow is not None:
            asked = HTTPConnection(scope)
            address = asked.client.host if asked.client else ""
            if not self.flow.fits(asked.cookies.get(COOKIE, ""), address):
                await refuse(scope, receive, send, STATUS, WORDS)
                return
        await self._app(scope, receive, send)
