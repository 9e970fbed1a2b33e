"""The scene under our own address, and nowhere else."""

import http.client
import socket
import threading
import urllib.request
from contextlib import closing

import pytest
from starlette.websockets import WebSocketDisconnect

from app.scene.server import SceneServer
from tests.desk import until
from tests.shell.conftest import ADDRESS, ORIGIN, SOCKET

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


def test_viser_has_no_port_and_no_thread_of_its_own():
    before = set(threading.enumerate())
    with closing(socket.socket()) as probe:
        listening = probe.fileno()
    server = SceneServer()
    try:
        started = set(threading.enumerate()) - before  # threads of earlier tests may end meanwhile
        assert not started and server.get_port() == 0
        with closing(socket.socket()) as probe:  # no file was opened in between
            assert probe.fileno() == listening
    finally:
        server.stop()


def test_a_page_of_another_version_is_turned_away(page):
    origin = {"origin": ADDRESS}  # the test client writes into what it is given
    opened = page.client.websocket_connect(f"{SOCKET}/scene", headers=origin, subprotocols=["viser-v0.9"])
    with pytest.raises(WebSocketDisconnect) as caught, opened:
        pass
    assert caught.value.code == 1002


def test_what_no_page_says_ends_that_page_alone(page):
    opened = {"headers": ORIGIN, "subprotocols": [PROTOCOL]}
    with page.client.websocket_connect(f"{SOCKET}/scene", **opened) as other:
        with page.client.websocket_connect(f"{SOCKET}/scene", **opened) as scene:
            scene.send_bytes(b"\x81\xa4type\xa4None")
            with pytest.raises(WebSocketDisconnect) as caught:
                while True:
                    scene.receive_bytes()
            assert caught.value.code == 1001
        assert len(other.receive_bytes()) > 100


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
