"""One viser server a session: it answers only the bridge, and opens no way to the outside.

viser listens on a port of this machine that any local program or page could try. So its websocket takes connections of
one origin only, a secret drawn at start, and its request for a public tunnel does nothing.
"""

from __future__ import annotations

import contextlib
import functools
import io
import secrets
import threading
from collections.abc import Iterator
from typing import Any

import viser
import viser._assignable_props_api as viser_properties
import websockets.asyncio.server as websocket_server

#: What the bridge says as its origin; nobody else knows it.
SECRET_ORIGIN = f"http://{secrets.token_hex(16)}"
_STARTING = threading.Lock()
# viser 1.1.1 looks up what types a node's properties have for every node anew, a seventh of the time that a session
# takes to open; they are the class's.
_PROPERTIES: Any = viser_properties
_PROPERTIES.get_type_hints = functools.cache(_PROPERTIES.get_type_hints)


class SceneServer(viser.ViserServer):
    """A server without a tunnel."""

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Never: a page may ask, nothing starts."""
        return None

    def stop(self) -> None:
        """Stops it, without viser's word on standard output: a session's end is none of a terminal's business."""
        with contextlib.redirect_stdout(io.StringIO()):
            super().stop()


@contextlib.contextmanager
def _answering_one_origin() -> Iterator[None]:
    """viser 1.1.1 hands no origins on to its websocket server; it is pinned, and a test asks from elsewhere."""
    serve: Any = websocket_server.serve

    def guarded(*args: Any, **named: Any) -> Any:
        return serve(*args, **{**named, "origins": [SECRET_ORIGIN]})

    with _STARTING:
        websocket_server.serve = guarded
        try:
            yield
        finally:
            websocket_server.serve = serve


def start_scene_server() -> SceneServer:
    """A server on a free port of this machine; takes a tenth of a second, so not for an event loop."""
    with _answering_one_origin(), contextlib.redirect_stdout(io.StringIO()):  # viser prints a banner
        server = SceneServer(host="127.0.0.1", port=0, label="Teachframe", verbose=False)
    server.scene.world_axes.visible = False
    return server
