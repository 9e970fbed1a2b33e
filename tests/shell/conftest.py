"""A page without a browser: Starlette's test client in front of the whole server."""

import json
import time

import pytest
from starlette.testclient import TestClient

from app.session import Store
from app.shell.server import Shell
from app.workers.hub import Hub
from tests.desk import brisk, patient, until  # noqa: F401

ADDRESS = "http://127.0.0.1:8080"
ORIGIN = {"origin": ADDRESS}
#: The test client takes another host for sockets unless told.
SOCKET = "ws://127.0.0.1:8080"


class Page:
    """One page with its socket open."""

    def __init__(self, client, hub):
        self.client, self.hub = client, hub
        client.get("/")
        self.socket = client.websocket_connect(f"{SOCKET}/words", headers=ORIGIN)

    def __enter__(self):
        self.socket.__enter__()
        until(lambda: self.hub.lives, "the session")
        self.live = self.hub.lives[-1]
        until(lambda: not self.live.context.worker._queue and self.live.context.views, "the screens")
        self.live.context.drive.override = 1.0
        return self

    def __exit__(self, *exc):
        self.socket.__exit__(*exc)

    def say(self, **message):
        self.socket.send_text(json.dumps(message))

    def hear(self, kind):
        """The next message of a kind."""
        while True:
            message = json.loads(self.socket.receive_text())
            if message["t"] == kind:
                return message

    def state(self):
        return self.client.get("/state").json()

    @property
    def q(self):
        return self.live.context.q.copy()

    def hold(self, seconds, **beat):
        """Says every 30 ms what is held."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.say(t="beat", **beat)
            time.sleep(0.03)


@pytest.fixture
def hub(tmp_path):
    hub = Hub(Store(tmp_path), robot="ur10e", linger=30.0)
    yield hub
    hub.close()


@pytest.fixture
def client(hub):
    with TestClient(Shell(hub, "127.0.0.1").app, base_url=ADDRESS) as client:
        yield client


@pytest.fixture
def page(client, hub):
    with Page(client, hub) as page:
        yield page
