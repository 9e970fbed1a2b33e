"""Joining, logging in and what a person reads where that cannot be."""

import json
import threading

import pytest

from app.people import limits
from app.shell.security import COOKIE
from tests.desk import until
from tests.people.conftest import PASSWORD, PIN
from tests.shell.accounts.forms import come, do
from tests.shell.conftest import ORIGIN, SOCKET


def test_who_is_not_logged_in_is_shown_the_way(browser):
    answer = browser().get("/")
    assert answer.status_code == 303 and answer.headers["location"] == "/login"


def test_a_trainee_joins_works_leaves_and_comes_back_to_his_session(browser, school, hub):
    client = browser()
    code = school["class1"].code
    assert come(client, "/join", code=code, name="Zhang Wei", pin=PIN).headers["location"] == "/"
    assert client.get("/").status_code == 200
    with client.websocket_connect(f"{SOCKET}/words", headers=ORIGIN) as socket:
        while (message := json.loads(socket.receive_text()))["t"] != "hello":
            pass
    assert message["person"] == "Zhang Wei"
    session = hub.lives[-1].session.name
    assert do(client, "/logout").headers["location"] == "/login"
    assert client.get("/").status_code == 303 and client.get("/state").status_code == 401
    again = browser()
    come(again, "/join", code=code, name="zhang wei", pin=PIN)
    again.get("/")
    assert hub.lives[-1].session.name == session


@pytest.mark.parametrize(
    "path, fields, status, said",
    [
        ("/login", {"login": "admin", "secret": "wrong"}, 401, "Wrong name, password or PIN."),
        ("/login", {"login": "nobody", "secret": PASSWORD}, 401, "Wrong name, password or PIN."),
        ("/login", {}, 401, "Wrong name, password or PIN."),
        ("/join", {"code": "nonesuch", "name": "A", "pin": PIN}, 400, "No class has this code"),
        ("/join", {"code": "CLASS", "name": "Trainee 1", "pin": "739105"}, 401, "Wrong name"),
        ("/join", {"code": "CLASS", "name": "New", "pin": "1234"}, 400, "A PIN has"),
        ("/join", {"code": "CLASS", "name": " ", "pin": PIN}, 400, "A name has"),
    ],
)
def test_what_cannot_be_gets_one_clear_line(browser, school, path, fields, status, said):
    fields = {k: school["class1"].code if v == "CLASS" else v for k, v in fields.items()}
    client = browser()
    answer = come(client, path, **fields)
    assert answer.status_code == status and said in answer.text and COOKIE + "=" not in str(answer.headers)
    assert PASSWORD not in answer.text and PIN not in answer.text


def test_pages_speak_chinese_and_say_names_as_text(browser, school):
    client = browser()
    assert "登录" in client.get("/login", headers={"accept-language": "zh-CN,en;q=0.5"}).text
    assert "登录" in client.get("/login?language=zh").text
    assert "登录" in client.get("/login").text, "the choice is kept"
    answer = come(client, "/join", code=school["class1"].code, name="<script>alert(1)</script>", pin="1")
    assert "<script>" not in answer.text and "&lt;script&gt;" in answer.text
    assert "script-src" not in answer.headers["content-security-policy"]
    assert "default-src 'none'" in answer.headers["content-security-policy"]


def test_the_sixth_try_in_a_minute_is_turned_away(browser, school):
    client = browser()
    for _ in range(limits.TRIES.most):
        assert come(client, "/login", login="admin", secret="wrong").status_code == 401
    answer = come(client, "/login", login="admin", secret=PASSWORD)
    assert answer.status_code == 429 and "Too many tries" in answer.text


def test_while_many_log_in_the_others_work_and_one_too_many_is_told(browser, school, people, monkeypatch):
    monkeypatch.setattr("app.shell.coming_in.WAITING", 3)
    sure, go = browser(school["trainee1"]), threading.Event()
    right = people.authenticate
    monkeypatch.setattr(people, "authenticate", lambda *said: (go.wait(20.0), right(*said))[1])
    answers, others = [], [browser() for _ in range(4)]
    logging = [
        threading.Thread(
            target=lambda c=c: answers.append(come(c, "/login", login="admin", secret=PASSWORD).status_code)
        )
        for c in others
    ]
    for thread in logging:
        thread.start()
    until(lambda: answers, "the answer to one too many")
    assert answers == [503] and sure.get("/account").status_code == 200
    go.set()
    for thread in logging:
        thread.join()
    assert sorted(answers) == [303, 303, 303, 503]
