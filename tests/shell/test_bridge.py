"""The scene under our own address, and its own port closed to everybody else."""

import http.client
import urllib.request

import pytest
from websockets.sync.client import connect

from app.scene.server import SECRET_ORIGIN
from tests.desk import until
from tests.shell.conftest import ORIGIN, SOCKET

PROTOCOL = "viser-v1.1.1"


def test_the_scene_comes_through_the_bridge_as_viser_sends_it(page):
    with page.client.websocket_connect(f"{SOCKET}/scene", headers=ORIGIN, subprotocols=[PROTOCOL]) as scene:
        assert scene.accepted_subprotocol == PROTOCOL
        assert sum(len(scene.receive_bytes()) for _ in range(2)) > 1000


def test_the_scenes_page_shows_no_panel_of_visers_and_stays_the_same(page):
    answer = page.client.get("/scene/")
    assert b"mantine-Paper-root" in answer.content and b"hasFocus" in answer.content
    assert "frame-ancestors 'self'" in answer.headers["content-security-policy"]
    assert "'unsafe-eval'" not in answer.headers["content-security-policy"]
    again = page.client.get("/scene/", headers={"if-none-match": answer.headers["etag"]})
    assert again.status_code == 304 and not again.content


@pytest.mark.parametrize(
    "query", ["websocket=ws://evil.example", "initialCameraPosition=1,2,3", "fixedDpr=1&x=1"]
)
def test_the_scene_cannot_be_pointed_elsewhere(page, query):
    assert page.client.get(f"/scene/?{query}").status_code == 400
    assert page.client.get("/scene/?fixedDpr=0.5").status_code == 200


@pytest.mark.parametrize("origin", ["http://127.0.0.1:8080", "null", "https://evil.example", None])
def test_visers_own_port_answers_the_bridge_alone(page, origin):
    port = page.live.scene_port
    with pytest.raises(Exception) as caught:
        connect(f"ws://127.0.0.1:{port}", origin=origin, subprotocols=[PROTOCOL])  # type: ignore[arg-type]
    assert getattr(getattr(caught.value, "response", None), "status_code", 0) == 403
    with connect(f"ws://127.0.0.1:{port}", origin=SECRET_ORIGIN, subprotocols=[PROTOCOL]) as scene:  # type: ignore
        assert len(scene.recv()) > 100


def test_a_request_for_a_public_tunnel_starts_nothing(page, monkeypatch):
    monkeypatch.setattr(urllib.request, "urlopen", lambda *a, **k: pytest.fail("asked the outside"))
    monkeypatch.setattr(http.client, "HTTPSConnection", lambda *a, **k: pytest.fail("asked the outside"))
    server = page.live._server
    assert server.request_share_url() is None and server._share_tunnel is None


def test_the_bridge_ends_with_the_page(page):
    server = page.live._server
    with page.client.websocket_connect(f"{SOCKET}/scene", headers=ORIGIN, subprotocols=[PROTOCOL]) as scene:
        scene.receive_bytes()
        connections = server._websock_server._client_state_from_id
        until(lambda: len(connections) == 1, "the connection")
    until(lambda: len(connections) == 0, "its end")
