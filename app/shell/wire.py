"""uvicorn's protocols, and what they do otherwise here.

How much of a connection is taken in at a time: who sends as fast as he can must not hold the loop. asyncio hands up to
256 kB to the protocol in one turn. Of small messages that are five thousand, and 40 ms in which nobody else is heard.
"""

from __future__ import annotations

import asyncio

from uvicorn._types import ASGISendEvent
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

PIECE = 32_768  # bytes: some 700 small messages, 5 ms


class Sockets(WebSocketsSansIOProtocol):
    """uvicorn's protocol of sockets. It takes one that was answered instead of accepted (another origin, another
    process has it) for a fault of the program, and writes an error into the log each time."""

    async def send(self, message: ASGISendEvent) -> None:
        """One message to the page."""
        await super().send(message)
        if message["type"] == "websocket.http.response.body" and not message.get("more_body", False):
            self.handshake_complete = True


class Wire(H11Protocol):
    """uvicorn's protocol; connections that become sockets keep the transport, and so the bound."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Bounds what one turn reads."""
        transport.max_size = PIECE  # type: ignore[attr-defined]
        super().connection_made(transport)
