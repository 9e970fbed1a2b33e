"""Every door of the server as everybody the table of doors names."""

import asyncio
import re

import pytest
from starlette.requests import HTTPConnection
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocketDisconnect

from app.people.doors import DOORS, HIS_TRAINER, SELF, STANDINGS, STRANGER
from app.shell.security import COOKIE
from tests.people.conftest import PASSWORD
from tests.shell.accounts.conftest import serving
from tests.shell.conftest import ORIGIN, SOCKET


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    """One server for all doors: none of these cases leaves anything that another asks about."""
    with serving(tmp_path_factory.mktemp("doors")) as served:
        yield served


@pytest.fixture(scope="module")
def everybody(served):
    """Standing -> a browser of somebody who stands so to the first trainee, and the page opened where he may."""
    people = {
        STRANGER: served.browser(),
        SELF: served.browser(served.school["trainee1"]),
        HIS_TRAINER: served.browser(served.school["trainer1"], PASSWORD),
        "trainee": served.browser(served.school["trainee2"]),
        "trainer": served.browser(served.school["trainer2"], PASSWORD),
        "administrator": served.browser(served.school["administrator"], PASSWORD),
    }
    assert set(people) == set(STANDINGS)
    for client in people.values():
        client.get("/")
    return people


def socket_opens(client, path):
    try:
        with client.websocket_connect(SOCKET + path, headers=ORIGIN) as socket:
            if path == "/words":
                socket.receive_text()
        return True
    except WebSocketDisconnect as gone:
        return gone.code not in (4401, 1008)


def test_a_stranger_finds_every_door_of_the_server_closed_but_the_way_in(everybody):
    client = everybody[STRANGER]
    for path in ("/", "/account"):
        assert client.get(path).headers["location"] == "/login"
    for path in ("/state", "/scene/", "/download/abc"):
        assert client.get(path).status_code == 401
    assert client.put("/upload/1/abc?last=1", content=b"x", headers=ORIGIN).status_code == 401
    assert not socket_opens(client, "/words") and not socket_opens(client, "/scene")
    for path in ("/logout", "/account/secret", "/account/join", "/account/export", "/account/erase"):
        assert client.post(path, headers=ORIGIN).headers["location"] == "/login"


def test_every_path_of_the_server_stands_in_the_table(shell):
    served = set()
    for route in shell._routes:
        if isinstance(route, Route | WebSocketRoute):
            served.add(re.sub(r"\{(\w+)(:\w+)?\}", lambda m: m[1].upper(), route.path))
    named = {path for door in DOORS.values() for path in door.where}
    assert served <= named, served - named


@pytest.mark.parametrize("standing", STANDINGS)
def test_nobody_but_he_himself_reaches_a_persons_work(everybody, school, hub, standing):
    """The pendant's addresses name no session: everybody is shown his own, so what others have cannot be reached."""
    his = hub.find(school["trainee1"].owner)
    his._give("mine.txt", b"his own")
    his_token = his.downloads()[-1].token
    client = everybody[standing]
    got = client.get(f"/download/{his_token}")
    assert (got.status_code == 200) == (standing in DOORS["download"].who), standing
    assert (got.content == b"his own") == (standing in DOORS["download"].who)


@pytest.mark.parametrize("deed", ["open", "export", "replay", "report", "records", "watch", "copy", "hint"])
@pytest.mark.parametrize("standing", STANDINGS)
def test_the_doors_to_a_session_open_as_the_table_says(shell, everybody, school, deed, standing):
    cookie = everybody[standing].cookies.get(COOKIE, "")
    scope = {"type": "http", "headers": [(b"cookie", f"{COOKIE}={cookie}".encode())]}
    let = asyncio.run(shell._entrance.let(HTTPConnection(scope), deed, school["trainee1"].owner))
    assert (let is not None) == (standing in DOORS[deed].who)
    if let is None and standing != STRANGER:
        refused = shell._entrance.people.audit.read(most=1)[0]
        assert refused.deed == f"refused_{deed}" and refused.about == school["trainee1"].owner
