"""viser can ask a server on the outside for a public address; here it cannot."""

import http.client
import threading

import msgspec.msgpack
import pytest
import viser._messages as messages

from app.session import Store
from app.shell.server import PendantServer
from tests.shell.hand import Hand

pytestmark = pytest.mark.xdist_group("pendant_server")


@pytest.fixture
def server(tmp_path):
    server = PendantServer(Store(tmp_path), port=0, robot="ur10e")
    yield server
    server.stop()


def test_the_request_itself_sent_by_a_page_of_ours_starts_nothing(server, monkeypatch):
    asked = []
    real = http.client.HTTPSConnection.__init__
    monkeypatch.setattr(
        http.client.HTTPSConnection, "__init__", lambda self, *a, **k: asked.append(a) or real(self, *a, **k)
    )
    hand = Hand(server.port, scene=True)
    (live,) = server.lives
    before = {thread.name for thread in threading.enumerate()}
    request = messages.ShareUrlRequest()
    hand._scene.send(msgspec.msgpack.encode(request.as_serializable_dict()))
    hand.fetch("/state")
    assert live._server._share_tunnel is None
    assert not asked and not [
        t for t in threading.enumerate() if "tunnel" in t.name.lower() and t.name not in before
    ]
    hand.close()
