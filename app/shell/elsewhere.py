"""What is open in another process of this machine: the worker says which, and the front asks there instead."""

from __future__ import annotations

import re

from starlette.websockets import WebSocket

#: Of an answer that only the front reads: it never leaves it.
_STATUS = 421
_HEADER = "x-teachframe-process"
_SAID = re.compile(
    rb"HTTP/1\.1 421 .*^x-teachframe-process: ([0-9]{1,9})\r$", re.MULTILINE | re.DOTALL | re.IGNORECASE
)
#: What a front adds to a request that may be sent on, once.
MAY_BE = b"X-Teachframe-Front: 1"
_MAY_BE = "x-teachframe-front"


async def sent_on(page: WebSocket, process: int) -> bool:
    """Refuses a socket that is not accepted yet with the process that has what it asks for.

    Returns:
        False where no front stands before this server, or it was sent on already: nothing was answered.
    """
    if page.headers.get(_MAY_BE) != "1" or "websocket.http.response" not in page.scope.get("extensions", {}):
        return False
    headers = [(_HEADER.encode(), str(process).encode()), (b"content-length", b"0")]
    await page.send({"type": "websocket.http.response.start", "status": _STATUS, "headers": headers})
    await page.send({"type": "websocket.http.response.body", "body": b""})
    return True


def process_said(head: bytes) -> int | None:
    """The process that an answer's head names."""
    found = _SAID.match(head)
    return int(found[1]) if found else None
