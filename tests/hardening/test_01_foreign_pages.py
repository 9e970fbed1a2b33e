"""Over the network, as a browser on another site would try: no socket, no file, no page for a foreign Origin or Host.

The doors one by one, without a network: tests/shell/test_doors.py.
"""

import http.client

import pytest
from websockets.exceptions import InvalidHandshake
from websockets.sync.client import connect

from app.session import Store
from app.shell.server import PendantServer
from tests.shell.hand import PROTOCOL, Hand

pytestmark = pytest.mark.xdist_group("pendant_server")
FOREIGN = ["https://evil.example", "null", "http://127.0.0.1:1", "http://127.0.0.1.evil.example", None]


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    server = PendantServer(Store(tmp_path_factory.mktemp("data")), port=0, robot="ur10e")
    yield server
    server.stop()


@pytest.fixture(scope="module")
def hand(server):
    hand = Hand(server.port)
    yield hand
    hand.close()


@pytest.mark.parametrize("origin", FOREIGN)
@pytest.mark.parametrize("path", ["/words", "/scene"])
def test_a_foreign_page_with_the_persons_own_cookie_opens_no_socket(server, hand, path, origin):
    with pytest.raises(InvalidHandshake):
        connect(
            f"ws://127.0.0.1:{server.port}{path}",
            origin=origin,
            additional_headers={"Cookie": hand.cookie},
            subprotocols=[PROTOCOL],
        )


@pytest.mark.parametrize(
    "host", ["evil.example", f"evil.example:{80}", "127.0.0.1.evil.example", "[::1", "\xff"]
)
def test_another_name_for_this_machine_is_not_answered(server, host):
    asked = http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)
    asked.putrequest("GET", "/", skip_host=True)
    asked.putheader("Host", host)
    asked.endheaders()
    assert asked.getresponse().status in (400, 421)
    asked.close()


def test_a_foreign_page_sends_no_file(server, hand):
    asked = http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)
    asked.request(
        "PUT",
        "/upload/1/abc?last=1",
        body=b"x",
        headers={"Cookie": hand.cookie, "Origin": "https://evil.example"},
    )
    assert asked.getresponse().status == 403
    asked.close()
