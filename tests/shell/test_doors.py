"""Who is let in: addresses that are served, pages of our own, browsers that hold the secret."""

import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.shell.security import COOKIE
from app.shell.server import Shell
from tests.shell.conftest import ADDRESS, ORIGIN, SOCKET

FOREIGN = [
    "https://evil.example",
    "null",
    "",
    "http://127.0.0.1:9",
    "http://127.0.0.1:8080.evil.example",
    "file://",
]
SOCKETS = ["/words", "/scene"]


def refused(client, path, headers):
    with pytest.raises(Exception) as caught, client.websocket_connect(SOCKET + path, headers=headers):
        pass
    assert isinstance(caught.value, WebSocketDisconnect) or getattr(caught.value, "status_code", 0) == 403
    return caught.value


@pytest.mark.parametrize("origin", FOREIGN)
@pytest.mark.parametrize("path", SOCKETS)
def test_no_page_from_elsewhere_opens_a_socket(client, path, origin):
    client.get("/")
    refused(client, path, {"origin": origin})


@pytest.mark.parametrize("path", SOCKETS)
def test_a_socket_without_an_origin_is_not_opened(client, path):
    client.get("/")
    refused(client, path, {})


@pytest.mark.parametrize("path", SOCKETS)
def test_a_socket_without_the_secret_is_not_opened(client, path):
    with (
        pytest.raises(WebSocketDisconnect),
        client.websocket_connect(SOCKET + path, headers=ORIGIN) as socket,
    ):
        socket.receive_text()


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8080", "127.0.0.1.evil.example", "10.0.0.7:8080", ""]
)
@pytest.mark.parametrize("path", ["/", "/state", "/scene/", "/static/main.js"])
def test_only_the_address_that_is_served_is_answered(client, host, path):
    assert client.get(path, headers={"host": host}).status_code == 421


@pytest.mark.parametrize("host", ["localhost:8080", "127.0.0.1:8080", "LOCALHOST"])
def test_the_own_names_of_this_machine_are_answered(client, host):
    assert client.get("/", headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "host, answer", [("192.168.1.20:8080", 200), ("evil.example", 421), ("[fe80::1]:8080", 200)]
)
def test_a_server_for_a_network_answers_to_numbers_and_to_no_name(hub, host, answer):
    client = TestClient(Shell(hub, "0.0.0.0").app, base_url=ADDRESS)
    assert client.get("/static/main.js", headers={"host": host}).status_code == answer


@pytest.mark.parametrize("origin", FOREIGN)
def test_no_page_from_elsewhere_sends_a_file(client, origin):
    client.get("/")
    headers = {"origin": origin} if origin else {}
    assert client.put("/upload/1/abc?last=1", content=b"x", headers=headers).status_code == 403


def test_the_secret_is_kept_from_scripts_and_from_other_sites(client):
    said = client.get("/").headers["set-cookie"].lower()
    assert COOKIE in said and "httponly" in said and "samesite=strict" in said


@pytest.mark.parametrize("path", ["/state", "/scene/", "/download/abc"])
def test_without_the_secret_there_is_nothing(client, path):
    assert client.get(path).status_code == 401


def test_nobody_is_shown_the_page_inside_his_own(client):
    policy = client.get("/").headers["content-security-policy"]
    assert (
        "frame-ancestors 'none'" in policy and "script-src 'self';" in policy and "unsafe-eval" not in policy
    )


def test_the_page_is_small_and_holds_no_script_of_its_own(client):
    import re
    from pathlib import Path

    from app.shell.server import PAGES

    page = client.get("/").text
    assert not re.search(r"<script(?![^>]*src=)|\son\w+=", page)
    assert sum(p.stat().st_size for p in Path(PAGES).iterdir()) < 200_000
