"""The pendant's server: each browser gets its own session, and gets it back after a reload."""

from __future__ import annotations

import contextlib
import gc
import io
import logging
import threading
import time
from collections.abc import Callable

import viser

from app.kinematics import RobotModel
from app.pendant.client import Pendant
from app.pendant.hub import Hub
from app.pendant.look import LOOK, Look
from app.pendant.shelf import Shelf
from app.session import Session, Store
from app.simulation.world import World, default_world
from app.training.records import Records

_TOKEN = "teachframe.session"
_ANSWER_WITHIN = 10.0  # seconds a browser has to say which session is its own
_THROUGH = 0.05  # seconds in which viser is through with the message it is at: it warns where its answer goes nowhere
_LOG = logging.getLogger(__name__)


class PendantServer:
    """Serves the pendant until it is stopped.

    Args:
        store: where sessions are kept.
        host, port: where to listen; port 0 takes any free one.
        robot: arm of new sessions; None takes the usual one.
        world_of: the cell of an arm.
    """

    def __init__(
        self,
        store: Store,
        *,
        host: str = "127.0.0.1",
        port: int = 8080,
        robot: str | None = None,
        world_of: Callable[[RobotModel], World] = default_world,
    ):
        self.hub = Hub(store, robot)
        self._host, self._world_of = host, world_of
        self._shelf = Shelf(store, Records(store.database), self.hub.in_use, self._switch)
        self._pendants: dict[int, Pendant] = {}
        self._leaving: list[Pendant] = []  # views that are being closed
        self._stopping = False
        self._lock = threading.Lock()
        with contextlib.redirect_stdout(io.StringIO()):  # its own banner would stand before our address
            self._viser = viser.ViserServer(host=host, port=port, label="Teachframe", verbose=False)
        self._viser.scene.world_axes.visible = False
        self._viser.gui.configure_theme(show_share_button=False, show_logo=False)
        self._viser.on_client_connect(self._connected)
        self._viser.on_client_disconnect(self._gone)

    @property
    def port(self) -> int:
        """Where it really listens."""
        return self._viser.get_port()

    @property
    def address(self) -> str:
        """What to open in a browser."""
        host = "127.0.0.1" if self._host in ("0.0.0.0", "") else self._host
        return f"http://{host}:{self.port}"

    @property
    def pendants(self) -> list[Pendant]:
        """The views of all connected browsers."""
        with self._lock:
            return list(self._pendants.values())

    def wait(self) -> None:
        """Serves until somebody interrupts."""
        while True:
            time.sleep(3600.0)

    def stop(self) -> None:
        """Closes every session and stops listening."""
        with self._lock:
            self._stopping = True  # who is just coming in gets no view any more
            left, self._pendants = [*self._pendants.values(), *self._leaving], {}
        for pendant in left:  # of one whose browser leaves at this moment: waits until its worker has ended
            self._end(pendant)
        time.sleep(_THROUGH * bool(left))
        self._viser.stop()

    def _connected(self, client: viser.ClientHandle) -> None:
        """Runs on a thread of viser's pool, because asking the browser for its token waits for the answer."""
        token = self._remembered(client, _TOKEN)
        look = Look() if token is None else Look.read(self._remembered(client, LOOK))
        if self._stopping or client.client_id not in self._viser.get_clients():
            return
        session, how = self.hub.enter(token)
        if session.name != token:
            client.local_storage.set_item(_TOKEN, session.name)
        self._show(client, session, how, look)
        if client.client_id not in self._viser.get_clients():  # left while the page was made
            self._gone(client)

    @staticmethod
    def _remembered(client: viser.ClientHandle, key: str) -> str | None:
        """What a browser keeps under a name; None where it keeps nothing, is gone again, or its storage is shut."""
        try:
            return client.local_storage.get_item(key, timeout=_ANSWER_WITHIN)
        except (RuntimeError, TimeoutError):
            return None

    def _show(self, client: viser.ClientHandle, session: Session, how: str, look: Look) -> None:
        self.hub.claim(session.name)
        with self._lock:
            if self._stopping:
                return
            pendant = Pendant(client, session, self._world_of, self._shelf, look)
            self._pendants[client.client_id] = pendant
        self.hub.show(session.name, pendant)
        pendant.greet(how)

    def _switch(self, number: int, name: str) -> None:
        """Hands a browser another session, on a thread of its own: the worker that asked for it ends with its view."""
        threading.Thread(target=self._switched, args=(number, name), daemon=True).start()

    def _switched(self, number: int, name: str) -> None:
        client = self._viser.get_clients().get(number)
        if client is None or self.hub.in_use(name):
            return
        with self._lock:
            before = self._pendants.get(number)
        look = Look() if before is None else before.look
        self._gone(client)
        session, how = self.hub.enter(name)
        client.local_storage.set_item(_TOKEN, session.name)
        with client.atomic():
            client.gui.reset()
            client.scene.reset()
        self._show(client, session, how, look)

    def _gone(self, client: viser.ClientHandle) -> None:
        with self._lock:
            pendant = self._pendants.pop(client.client_id, None)
            if pendant is None:
                return
            self._leaving.append(pendant)
        try:
            self._end(pendant)
        finally:
            with self._lock:
                self._leaving.remove(pendant)
        del pendant
        gc.collect()  # viser's handles hold each other in rings

    def _end(self, pendant: Pendant) -> None:
        try:
            pendant.close()
        finally:
            self.hub.leave(pendant.session.name, pendant)
