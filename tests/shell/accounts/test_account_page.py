"""What somebody keeps and loses: his PIN, his class, his log-in, all that is kept about him."""

import io
import json
import zipfile

import pytest
from starlette.websockets import WebSocketDisconnect

from tests.people.conftest import PIN
from tests.shell.accounts.forms import come, do
from tests.shell.conftest import ORIGIN, SOCKET


def test_an_ended_log_in_closes_the_page_and_stops_the_arm(browser, school, people, hub, monkeypatch):
    monkeypatch.setattr("app.shell.words._STILL", 0.05)
    client = browser(school["trainee1"])
    client.get("/")
    with client.websocket_connect(f"{SOCKET}/words", headers=ORIGIN) as socket:
        people.logins.end_all(school["trainee1"].id)
        with pytest.raises(WebSocketDisconnect) as caught:
            while True:
                socket.receive_text()
    assert caught.value.code == 4401


def test_a_class_deleted_under_a_running_lesson_takes_nothing_away(browser, school, people, hub):
    client = browser(school["trainee1"])
    client.get("/")
    with client.websocket_connect(f"{SOCKET}/words", headers=ORIGIN) as socket:
        people.classes.delete(school["class1"].id)
        assert json.loads(socket.receive_text())["t"] in ("hello", "panel", "read")
        assert client.get("/state").status_code == 200 and client.get("/account").status_code == 200
        assert "Class 1" not in client.get("/account").text
    other = browser()
    answer = come(other, "/join", code=school["class1"].code, name="Trainee 1", pin=PIN)
    assert answer.status_code == 400 and "No class has this code" in answer.text
    assert not people.may(school["trainer1"], "watch", school["trainee1"].owner)


def test_everything_kept_is_given_and_erased(browser, school, people, hub):
    client, person = browser(school["trainee1"]), school["trainee1"]
    client.get("/")
    session = hub.find(person.owner).session.name
    packed = zipfile.ZipFile(io.BytesIO(do(client, "/account/export").content))
    assert f"sessions/{session}.jsonl" in packed.namelist() and "people.jsonl" in packed.namelist()
    assert person.login in packed.read("people.jsonl").decode() and "argon2" not in str(
        [packed.read(name) for name in packed.namelist()]
    )
    assert do(client, "/account/erase", secret="000000").status_code == 400, "the PIN is asked for once more"
    assert do(client, "/account/erase", secret=PIN).status_code == 303
    assert people.get(person.id) is None and not hub.store.has(session) and hub.find(person.owner) is None
    assert client.get("/account").status_code == 303
    assert {entry.deed for entry in people.audit.read(person=person.id)} >= {"add", "take_along", "erase"}


def test_another_pin_is_taken_where_the_one_before_is_known(browser, school, people):
    client = browser(school["trainee1"])
    assert do(client, "/account/secret", secret="111222", new="739105", again="739105").status_code == 400
    assert do(client, "/account/secret", secret=PIN, new="739105", again="739106").status_code == 400
    assert do(client, "/account/secret", secret=PIN, new="739105", again="739105").status_code == 303
    assert client.get("/account").status_code == 303, "every browser has to log in anew"
    assert browser(school["trainee1"], "739105").get("/account").status_code == 200


def test_sessions_of_nobody_are_nobodys_where_there_are_accounts(browser, school, hub):
    left = hub.store.create(robot="ur10e")
    left.close()
    client = browser(school["trainee1"])
    client.get("/")
    shelf = hub.find(school["trainee1"].owner).context.shelf
    assert not shelf.may(left.name) and left.name not in {listed.name for listed, _ in shelf.mine(60)}
