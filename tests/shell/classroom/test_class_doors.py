"""Every page of a class, as everybody the table of doors names: let in where it says so, and nowhere else."""

import pytest
from starlette.websockets import WebSocketDisconnect

from app.people.doors import DOORS, STANDINGS
from app.training.exercise import exercise, exercise_text
from tests.desk import Desk
from tests.shell.classroom.conftest import SECRET

PREFIXES = ("/class", "/exercises", "/lessons")
FORMS = {  # how a door that takes a form is knocked at
    "/classes": {"name": "Another"},
    "/class/AT/lessons": {"exercise": "heavy_gun"},
    "/class/AT/helps": {},
    "/class/AT/lesson/LESSON": {"do": "change"},
    "/class/AT/dismiss/WHO": {},
    "/class/AT": {"do": "rename", "name": "Monday"},
    "/class/AT/copy/WHO": {},
    "/class/AT/hint/WHO": {"text": "Tilt more."},
    "/class/AT/pin/WHO": {"pin": "1"},  # no PIN: it is refused as one, behind the door
    "/exercises/new": {},
    "/exercises/file": {"text": "touches ="},
    "/exercises/KEY": {"do": "nothing"},
    "/lessons/LESSON": {},
}
ONLY_FORMS = (
    "helps",
    "dismiss",
    "copy",
    "hint",
    "pin",
    "/exercises/file",
    "/exercises/KEY",
    "/lessons/LESSON",
)
SOCKETS = ("/class/AT/watch/WHO/scene", "/class/AT/watch/WHO/words")


def knocks():
    """(deed, door, way) of every page and socket of a class."""
    for deed, door in DOORS.items():
        for where in door.where:
            if not where.startswith(PREFIXES):
                continue
            if where in SOCKETS:
                yield deed, where, "socket"
                continue
            if not any(
                part in where.removesuffix(".toml") + (".toml" if where.endswith(".toml") else "")
                for part in ONLY_FORMS
            ) or where.endswith(".toml"):
                yield deed, where, "page"
            if where in FORMS:
                yield deed, where, "form"


@pytest.fixture
def everybody(hub, people, at, trainer, ada, bo, come_in, seated):
    """Standing -> somebody, for Ada's things and Tim's class; his session is open."""
    other = people.add("tom", "Tom", "trainer", SECRET)
    there = people.classes.make("Friday", other.id)
    eve = people.join(there.code, "Eve", "736251", "127.0.0.1")
    root = people.add("root", "Root", "administrator", SECRET)
    hub.room.assignments.give(at.id, "first_tool")
    Desk(seated.live).idle()
    return {
        "stranger": come_in(),
        "self": ada,
        "his_trainer": trainer,
        "trainee": come_in(eve),
        "trainer": come_in(other),
        "administrator": come_in(root),
    }


def stands(who, deed):
    """How somebody stands to what a door leads to: classes are their trainer's own, exercises nobody's."""
    own = {"class_change": {"his_trainer": "self", "self": "trainee"}}
    nobodys = {"his_trainer": "trainer", "self": "trainee"}
    ways = nobodys if deed in ("class_make", "exercise_make") else own.get(deed, {})
    return ways.get(who, who)


def opened(somebody, where, way, fields):
    """True where the door opened."""
    if way == "socket":
        try:
            with somebody.socket(
                where, subprotocols=["viser-v1.1.1"] if where.endswith("scene") else []
            ) as socket:
                message = socket.receive()
                return message["type"] == "websocket.send"
        except WebSocketDisconnect:
            return False
    if way == "form":
        from tests.shell.classroom.conftest import ORIGIN

        token = somebody.token() if somebody.person is not None else "0" * 64
        answer = somebody.client.post(
            where, data={"token": token, **fields}, headers=ORIGIN, follow_redirects=False
        )
    else:
        answer = somebody.client.get(where, follow_redirects=False)
    assert answer.status_code < 500, answer.text[:300]
    if answer.status_code == 303:
        return not answer.headers["location"].endswith("/login")
    return answer.status_code not in (401, 403, 404)


def test_every_door_lets_in_whom_the_table_names_and_nobody_else(hub, at, trainer, ada, everybody):
    made = hub.room.made.keep(trainer.person.id, exercise_text(exercise("first_tool")))
    lesson = hub.room.lessons(at.id)[0].id
    filled = {"AT": at.id, "WHO": ada.person.id, "LESSON": lesson, "KEY": made.key}
    wrong, tried = [], 0
    assert set(everybody) == set(STANDINGS)
    for deed, where, way in knocks():
        path = where
        for name, value in filled.items():
            path = path.replace(name, value)
        for who, somebody in everybody.items():
            table = stands(who, deed) in DOORS[deed].who
            # A page of a class belongs to the class as well: who may not see that sees nothing in it.
            inside = where.startswith("/class/")
            table = table and (not inside or stands(who, "class_change") in DOORS["class_change"].who)
            mine = where.startswith("/lessons")
            if mine:  # one's own lessons: everybody has some page, nobody another's lesson
                table = who != "stranger" and (where == "/lessons" or who == "self")
            tried += 1
            if opened(somebody, path, way, FORMS.get(where, {})) != table:
                wrong.append((who, way, where, "must" + ("" if table else " not") + " open"))
    assert not wrong, wrong
    assert tried >= 150


def test_another_classs_trainee_is_not_reached_through_ones_own_class(people, everybody, at, ada):
    """Ids of a class of one's own and of a person of another's do not add up to a door."""
    tom = everybody["trainer"]
    mine = people.classes.list(trainer=tom.person.id)[0]
    for where in ("person", "watch"):
        tom.get(f"/class/{mine.id}/{where}/{ada.person.id}", 404)
    tom.post(f"/class/{mine.id}/hint/{ada.person.id}", 404, text="Hello")
    tom.post(f"/class/{mine.id}/copy/{ada.person.id}", 404)
    for socket in ("scene", "words"):
        assert not opened(tom, f"/class/{mine.id}/watch/{ada.person.id}/{socket}", "socket", {})


def test_a_session_of_another_is_not_copied_by_its_name(hub, trainer, at, ada, everybody):
    other = everybody["trainer"]
    other.get("/")
    name = hub.owners.latest(other.person.owner)
    trainer.post(f"/class/{at.id}/copy/{ada.person.id}", 404, session=name)


def test_a_trainee_never_gets_the_file_of_an_exercise(hub, trainer, ada):
    """What is hidden stands in it."""
    made = hub.room.made.keep(trainer.person.id, exercise_text(exercise("bent_tip")))
    ada.get(f"/exercises/{made.key}.toml", 404)
    assert "tool_slip" in trainer.get(f"/exercises/{made.key}.toml").text
