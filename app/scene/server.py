"""One viser server a session: without a port, and without a way to the outside."""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import rich
import viser
import viser._assignable_props_api as viser_properties
import viser._scene_handles as viser_handles
import viser.infra

from app.scene.pages import Frames, Pages

_STARTING = threading.Lock()
# viser 1.1.1 looks up what types a node's properties have for every node anew, a seventh of the time that a session
# takes to open; they are the class's.
_PROPERTIES: Any = viser_properties
_PROPERTIES.get_type_hints = functools.cache(_PROPERTIES.get_type_hints)


def _set_pose(current: np.ndarray, value: Any, length: int, queue: Any, make_message: Any) -> None:
    """viser's own, but that a pose is the same where its numbers are: `np.allclose`, and arrays of three numbers, took
    half of what a turning joint costs."""
    numbers = tuple(map(float, value))
    if len(numbers) != length:
        raise ValueError(f"found {len(numbers)} numbers, expected {length}")
    if numbers != tuple(current.tolist()):
        current[:] = numbers
        queue(make_message(numbers))


_HANDLES: Any = viser_handles
_HANDLES._set_pose_vector = _set_pose
#: What a page must say it speaks.
PROTOCOL = f"viser-v{viser.__version__}"


class SceneServer(viser.ViserServer):
    """A server that shows its scene to the sockets it is handed."""

    _websock_server: Pages

    def __init__(self):
        with _without_a_port():
            super().__init__(host="127.0.0.1", port=0, label="Teachframe", verbose=False)
        self.scene.world_axes.visible = False
        self.sized: Callable[[], None] = lambda: None  # a new page has said how large its window is
        #: Width and height of the window as its page measures it [px]: viser counts the pixels it draws, and later.
        self.window: tuple[float, float] | None = None
        self.on_client_connect(self._arrived)

    def _arrived(self, client: viser.ClientHandle) -> None:
        waits = [True]

        @client.camera.on_update
        def _(_: viser.CameraHandle) -> None:
            if waits.pop() if waits else False:
                self.sized()

    async def show(self, page: Frames) -> None:
        """Shows the scene to a page until either ends; see Pages.show."""
        await self._websock_server.show(page)

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Never: a page may ask, nothing starts."""
        return None


@contextmanager
def _without_a_port() -> Iterator[None]:
    """viser takes no other server, and prints a banner with the address of the one it has."""
    infra: Any = viser.infra
    printing: Any = rich
    serving, said = infra.WebsockServer, printing.print
    with _STARTING:
        infra.WebsockServer, printing.print = Pages, lambda *_, **__: None
        try:
            yield
        finally:
            infra.WebsockServer, printing.print = serving, said
