"""A log-in that has ended says so: to its person, and once in the audit log. A database that is away ends none."""

import threading

import pytest
from sqlalchemy import update
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.errors import StorageError
from app.people.limits import FAILED, IDLE, LOGIN
from app.people.tables import LOGINS
from app.shell.security import COOKIE
from app.shell.signing import signed
from tests.people.conftest import PIN
from tests.shell.accounts.forms import come, do
from tests.shell.conftest import ADDRESS


def rested(people, person, seconds):
    with people.database.begin() as connection:
        values = {"last": LOGINS.c.last - seconds, "expires": LOGINS.c.expires - seconds}
        connection.execute(update(LOGINS).where(LOGINS.c.person == person.id).values(**values))


def deeds(people, person):
    return [entry.deed for entry in people.audit.read(person=person.id)]


@pytest.mark.parametrize("seconds", [IDLE + 1.0, LOGIN + 1.0])
def test_a_log_in_that_ran_out_is_told_and_noted_once(browser, people, school, seconds):
    ada = school["trainee1"]
    client = browser(ada)
    rested(people, ada, seconds)
    people.logins.begin(school["trainee2"].id)  # somebody else comes in between
    for _ in range(2):
        answer = client.get("/")
        assert answer.status_code == 303 and answer.headers["location"] == "/login?ended=1"
    page = client.get(answer.headers["location"]).text
    assert "has ended" in page and "2 hours" in page and "12" in page
    assert "已结束" in client.get("/login?ended=1&language=zh").text
    assert deeds(people, ada).count("log_in_ended") == 1
    assert come(client, "/login", login=ada.login, secret=PIN).headers["location"] == "/"


def test_who_logs_out_or_erases_himself_or_never_came_reads_nothing_of_an_end(browser, people, school):
    assert browser().get("/").headers["location"] == "/login"
    client = browser(school["trainee1"])
    assert do(client, "/logout").headers["location"] == "/login"
    assert client.get("/").headers["location"] == "/login"
    client = browser(school["trainee1"])
    assert do(client, "/account/erase", secret=PIN).headers["location"] == "/login"
    assert client.get("/").headers["location"] == "/login"
    assert "log_in_ended" not in deeds(people, school["trainee1"])


def test_a_lock_stands_in_the_audit_log(people, school, monkeypatch):
    ada = school["trainee1"]
    for number in range(FAILED):
        with pytest.raises(Exception, match="Wrong"):
            people.authenticate(ada.login, "000000x", f"10.0.0.{number}")
    assert deeds(people, ada).count("locked") == 1
    with pytest.raises(Exception, match="locked"):
        people.authenticate(ada.login, PIN, "10.0.1.1")


def test_a_socket_that_comes_while_the_database_is_away_is_asked_to_come_again(browser, served, monkeypatch):
    client = browser(served.school["trainee1"])

    def away(*_, **__):
        raise StorageError("away")

    monkeypatch.setattr(served.people.logins, "person", away)
    for path in ("/words", "/scene"):
        socket = client.websocket_connect(f"ws://127.0.0.1:8080{path}", headers={"origin": ADDRESS})
        with pytest.raises(WebSocketDisconnect) as closed, socket:
            pass
        assert closed.value.code == 1013, path


def test_who_asks_for_something_else_waits_for_nobody_whose_session_is_opened(served, school, monkeypatch):
    """As many as there are threads wait for leases and disks; log-ins are looked up meanwhile."""
    gate, came = threading.Event(), []
    enter = served.hub.enter

    def slowly(owner, *more):
        came.append(owner)
        gate.wait(60.0)
        return enter(owner, *more)

    monkeypatch.setattr(served.hub, "enter", slowly)
    key = served.shell._entrance.key
    cookies = {COOKIE: signed(key, served.people.logins.begin(school["trainee1"].id))}
    others = {COOKIE: signed(key, served.people.logins.begin(school["trainee2"].id))}
    with TestClient(served.shell.app, base_url=ADDRESS) as server:
        portal = server.portal
        tasks = [portal.start_task_soon(_asked, served.shell.app, "/", cookies) for _ in range(40)]
        answer = portal.start_task_soon(_asked, served.shell.app, "/account", others)
        try:
            assert answer.result(timeout=30.0) == 200
            assert came
        finally:
            gate.set()
        assert {task.result(timeout=60.0) for task in tasks} == {200}


async def _asked(app, path, cookies):
    """The status of an answer."""
    cookie = "; ".join(f"{name}={value}" for name, value in cookies.items())
    said = []

    async def send(message):
        said.append(message)

    async def receive():
        return {"type": "http.request", "body": b"", "more_body": False}

    scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": "GET",
        "scheme": "http",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "root_path": "",
        "headers": [(b"host", b"127.0.0.1:8080"), (b"cookie", cookie.encode())],
        "client": ("127.0.0.1", 1),
        "server": ("127.0.0.1", 8080),
    }
    await app(scope, receive, send)
    return said[0]["status"]
