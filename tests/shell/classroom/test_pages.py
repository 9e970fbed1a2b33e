"""Pages of a class: what a trainer sees and does, what a trainee sees."""

import csv
import io
import json
import re
import time

import msgspec
import pytest

from app.classroom.presence import Presence
from app.classroom.working import STATES
from app.figures import NO_BREAK
from app.training.exercise import exercise, exercise_text
from tests.shell.classroom.conftest import ORIGIN, plain
from tests.training.trainee import GOOD


def scored(hub, who, key="first_tool", seed=3):
    hub.records.add(who.person.id, "s", GOOD.scores(exercise(key), seed))


def test_a_class_is_made_and_deleted_in_the_page(hub, trainer):
    answer = trainer.post("/classes", name="Tuesday")
    assert "Tuesday" in trainer.see("/classes")
    path = answer.headers["location"].partition("?")[0]
    code = re.search(r'data-testid="code">(\w+)<', trainer.get(path).text)[1]
    trainer.post(path, do="code")
    assert code not in trainer.see(path)
    trainer.post(path, do="rename", name="Wednesday")
    assert "Wednesday" in trainer.see(path)
    trainer.post(path, do="delete")  # not without a tick
    assert trainer.see(path)
    trainer.post(path, do="delete", sure="on")
    assert "There is no such" in trainer.see(path, 404)


def test_lessons_are_assigned_ordered_and_taken_away(hub, trainer, at):
    for key in ("first_tool", "bent_tip"):
        trainer.post(f"/class/{at.id}/lessons", exercise=key, due="2030-01-02T08:00")
    first, second = hub.room.lessons(at.id)
    trainer.post(f"/class/{at.id}/lesson/{second.id}", do="up")
    trainer.post(f"/class/{at.id}/lesson/{first.id}", do="change", due="", help_distance="on")
    after = hub.room.lessons(at.id)
    assert [lesson.key for lesson in after] == ["bent_tip", "first_tool"]
    assert time.localtime(after[0].due)[:5] == (2030, 1, 2, 8, 0)
    assert after[1].due == 0.0 and after[1].without == ("closeup", "next_touch", "handle", "touch", "light")
    trainer.post(f"/class/{at.id}/helps", help_distance="on", help_touch="on")
    assert "touch" in hub.room.lessons(at.id)[1].without  # the lesson's own
    assert hub.room.lessons(at.id)[0].without == ("closeup", "next_touch", "handle", "light")
    trainer.post(f"/class/{at.id}/lesson/{first.id}", do="away")
    assert [lesson.key for lesson in hub.room.lessons(at.id)] == ["bent_tip"]
    assert "Lessons" in trainer.see(f"/class/{at.id}/lessons")


def test_the_grid_has_best_tries_error_time_and_state(hub, trainer, at, ada, bo):
    hub.room.assignments.give(at.id, "first_tool")
    scored(hub, ada, seed=3)
    scored(hub, ada, seed=4)
    now = time.time()
    hub.room.presences.keep([Presence(ada.person.owner, "s", "stuck", now - 240.0, now, "first_tool", 2, 4)])
    words = trainer.see(f"/class/{at.id}")
    best = max(card.total for card in hub.records.history(ada.person.id))
    assert f"{best:.0f}" in words and "tries: 2" in words and " mm" in words and "stuck" in words
    assert "for 4 min" in words and "My first tool point, points 2/4" in words and "Bo" in words


def test_the_live_states_are_counted_and_hints_are_followed(hub, trainer, at, ada, bo):
    now = time.time()
    hub.room.presences.keep([Presence(ada.person.owner, "s", "working", now, now, "first_tool", 1, 4)])
    trainer.post(f"/class/{at.id}/hint/{ada.person.id}", text="Tilt more.")
    news = trainer.get(f"/class/{at.id}/live").json()
    seats = {seat["person"]: seat for seat in news["seats"]}
    assert seats[ada.person.id]["state"] == "working" and seats[ada.person.id]["hint"] == "hint sent"
    assert seats[bo.person.id]["state"] == "away" and news["counts"] == {
        **dict.fromkeys(STATES, 0),
        "working": 1,
        "away": 1,
    }
    (hint,) = hub.room.hints.of(ada.person.owner)
    hub.room.hints.put_away(hint.id, ada.person.owner)
    assert "hint read" in json.dumps(trainer.get(f"/class/{at.id}/live").json())


def test_a_hint_arrives_within_a_second_and_says_that_he_got_it(hub, trainer, at, ada, seated):
    """Over the page's own socket: shown, acknowledged, put away."""
    hub.attending.look()
    with ada.socket("/words") as page:
        trainer.post(f"/class/{at.id}/hint/{ada.person.id}", text="Look from <b>two</b> sides.")
        sent = time.monotonic()
        while True:
            heard = json.loads(page.receive_text())
            if heard["t"] == "read" and heard["hint"]:
                break
        assert time.monotonic() - sent < 1.5 and heard["hinted"] == "Look from <b>two</b> sides."
        page.send_text(json.dumps({"t": "hint", "id": heard["hint"]}))
        page.send_text(json.dumps({"t": "hint", "id": heard["hint"], "away": True}))
        while json.loads(page.receive_text()).get("hint") != 0:
            pass
    (hint,) = hub.room.hints.of(ada.person.owner)
    assert hint.put_away >= hint.shown > 0
    assert "&lt;b&gt;" in trainer.get(f"/class/{at.id}/person/{ada.person.id}").text


def test_where_points_are_lost(hub, trainer, at, ada, bo):
    id = hub.room.assignments.give(at.id, "first_tool")
    for who in (ada, bo):
        scored(hub, who)
    words = trainer.see(f"/class/{at.id}/lesson/{id}")
    assert "Trainees: 2" in words and "Where points are lost" in words and "accuracy" in words


@pytest.mark.parametrize("name", ["scores", "moodle", "canvas"])
def test_tables_are_files(hub, trainer, at, ada, name):
    hub.room.assignments.give(at.id, "first_tool")
    scored(hub, ada)
    answer = trainer.get(f"/class/{at.id}/{name}.csv")
    assert (
        answer.headers["content-disposition"].startswith("attachment")
        and "sandbox" in answer.headers["content-security-policy"]
    )
    rows = list(csv.reader(io.StringIO(answer.text.lstrip("\ufeff"))))
    assert len({len(row) for row in rows}) == 1 and "Ada" in answer.text
    assert (f"export_{name}", at.id) in {(e.deed, e.about) for e in hub.room.people.audit.read()}


def test_a_trainee_sees_what_is_next_and_opens_it(hub, ada, at):
    hub.room.assignments.give(at.id, "first_tool", due=1.0)
    hub.room.assignments.give(at.id, "bent_tip")
    page = ada.get("/lessons").text
    ahead = plain(page[page.index('data-testid="next"') :][:900])
    assert "My first tool point" in ahead and "due" in ahead and "late" in plain(page)
    scored(hub, ada)
    page = ada.get("/lessons").text
    assert exercise("bent_tip").said("en").title in plain(page[page.index('data-testid="next"') :][:900])
    second = hub.room.lessons(at.id)[1]
    assert ada.post(f"/lessons/{second.id}").headers["location"] == "/"
    live = hub.find(ada.person.owner)
    from tests.desk import Desk, until

    desk = Desk(live)
    until(lambda: live.context.wanted_screen == "training", "the screen")
    desk.idle()
    assert desk.view("choose").chosen.key == "bent_tip"


def test_all_lessons_passed_is_said(hub, ada, at):
    hub.room.assignments.give(at.id, "first_tool")
    scored(hub, ada)
    assert "All lessons are passed." in ada.see("/lessons")


def test_a_class_deleted_under_an_open_page_says_so(hub, trainer, at, ada):
    trainer.get(f"/class/{at.id}")
    trainer.post(f"/class/{at.id}", do="delete", sure="on")
    trainer.get(f"/class/{at.id}/live", 404)
    assert "no such lesson, class or person" in trainer.see(f"/class/{at.id}", 404)
    trainer.post(f"/class/{at.id}/hint/{ada.person.id}", 404, text="Hello")
    assert "You are in no class" in ada.see("/lessons")


def test_a_lesson_file_with_a_mistake_is_a_line_for_both(hub, trainer, at, ada, monkeypatch):
    from app.training import exercise as shelf

    kept = hub.room.made.keep(trainer.person.id, exercise_text(exercise("first_tool")))
    hub.room.assignments.give(at.id, kept.key)
    hub.room.assignments.give(at.id, "bent_tip")
    monkeypatch.setattr(shelf, "_made", {})
    monkeypatch.setattr(hub.room.made, "text", lambda key: "touches =")
    assert "its file has a mistake" in trainer.see(f"/class/{at.id}")
    assert "not an exercise" in trainer.see(f"/class/{at.id}/lessons")
    assert "not an exercise" in trainer.see(f"/class/{at.id}/lesson/{hub.room.lessons(at.id)[0].id}")
    words = ada.see("/lessons")
    assert "cannot be done now" in words and exercise("bent_tip").said("en").title in words


@pytest.mark.parametrize(
    ("path", "fields"),
    [
        ("/class/{at}/hint/{ada}", {"text": ""}),
        ("/class/{at}/hint/{ada}", {"text": "x" * 301}),
        ("/class/{at}/lessons", {"exercise": "no_such"}),
        ("/class/{at}/lessons", {"exercise": "../../etc/passwd"}),
        ("/classes", {"name": " "}),
        ("/class/{at}", {"do": "rename", "name": "x" * 81}),
    ],
)
def test_what_cannot_be_is_one_line_and_changes_nothing(hub, trainer, at, ada, path, fields):
    answer = trainer.post(path.format(at=at.id, ada=ada.person.id), 400, **fields)
    said = re.search(r'data-testid="said">([^<]+)<', answer.text)[1]
    assert said and "Traceback" not in answer.text
    assert not hub.room.lessons(at.id) and not hub.room.hints.of(ada.person.owner)
    assert hub.room.people.classes.get(at.id).name == "Monday"


def test_a_form_without_its_token_or_from_elsewhere_does_nothing(hub, trainer, at, ada):
    path = f"/class/{at.id}/hint/{ada.person.id}"
    trainer.post(path, 403, token="0" * 64, text="Hello")
    answer = trainer.client.post(
        path, data={"token": trainer.token(), "text": "Hello"}, headers={"origin": "http://evil.example"}
    )
    assert answer.status_code == 403 and not hub.room.hints.of(ada.person.owner)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_page_is_whole_in_both_languages(hub, trainer, at, ada, language):
    for key in ("first_tool", "bent_tip"):
        hub.room.assignments.give(at.id, key, due=2e9)
    scored(hub, ada)
    scored(hub, ada, seed=4)
    hub.room.hints.send(trainer.person.id, ada.person.owner, "Tilt.")
    hub.room.made.keep(
        trainer.person.id, exercise_text(msgspec.structs.replace(exercise("first_tool"), touches=5))
    )
    lesson = hub.room.lessons(at.id)[0].id
    paths = [
        f"/class/{at.id}{rest}"
        for rest in (
            "",
            "/lessons",
            f"/lesson/{lesson}",
            f"/person/{ada.person.id}",
            f"/watch/{ada.person.id}",
        )
    ]
    for path in ("/classes", "/exercises", "/exercises/new", *paths):
        answer = trainer.get(f"{path}?language={language}")
        assert (
            f'lang="{language}"' in answer.text
            and "script-src 'self'" in answer.headers["content-security-policy"]
        )
        assert (
            not re.search(r"<script(?! type=\"module\" src=)", answer.text) and " style=" not in answer.text
        )
        assert not re.search(r"\son\w+=", answer.text)
        assert not re.search(r"{\w+}", plain(answer.text)), "a field of a text was not filled in"
    assert f'lang="{language}"' in ada.get(f"/lessons?language={language}").text


def test_names_are_shown_and_not_obeyed(hub, trainer, people, at, come_in):
    people.join(at.code, "<script>alert(1)</script>", "736251", "127.0.0.1")
    page = trainer.get(f"/class/{at.id}").text
    assert "<script>alert" not in page and "&lt;script&gt;alert" in page


def test_every_field_and_button_has_a_name(hub, trainer, at, ada):
    """Screen readers: a label around it, an aria-label, or words on the button."""
    hub.room.assignments.give(at.id, "first_tool")
    for path in (
        f"/class/{at.id}",
        f"/class/{at.id}/lessons",
        "/exercises",
        "/exercises/new",
        f"/class/{at.id}/person/{ada.person.id}",
    ):
        page = trainer.get(path).text
        for found in re.finditer(r"<(input|select|textarea)\b([^>]*)>", page):
            if 'type="hidden"' in found[2]:
                continue
            before = page[: found.start()]
            inside = before.rfind("<label") > before.rfind("</label>")
            assert inside or "aria-label=" in found[2], found[0]
        for found in re.finditer(r"<button\b([^>]*)>(.*?)</button>", page, re.S):
            assert plain(found[2]).strip() or "aria-label=" in found[1], found[0]
    assert ORIGIN


def test_what_was_not_ticked_is_not_said_to_be_done(trainer, people, at, ada):
    away = trainer.post(f"/class/{at.id}/dismiss/{ada.person.id}")
    deleted = trainer.post(f"/class/{at.id}", do="delete")
    assert "done" not in away.headers["location"] + deleted.headers["location"]
    assert people.classes.of(ada.person.id)


def test_figures_are_read_on_every_page_of_a_class_as_on_the_pendant(hub, trainer, at, ada):
    """A number stood at the end of one line and its unit on the next, and a trend of nothing had a sign."""
    hub.room.assignments.give(at.id, "first_tool")
    (lesson,) = hub.room.lessons(at.id)
    for seed in (3, 3):
        scored(hub, ada, seed=seed)
    now = time.time()
    hub.room.presences.keep([Presence(ada.person.owner, "s", "stuck", now - 240.0, now, "first_tool", 2, 4)])
    hub.room.made.keep(trainer.person.id, exercise_text(exercise("first_tool")))
    one = f"/class/{at.id}"
    places = (one, f"{one}/lesson/{lesson.id}", f"{one}/person/{ada.person.id}", "/exercises/new")
    pages = [trainer.get(place).text for place in places] + [ada.get("/lessons").text]
    words = [re.sub(r"<(textarea|code)\b.*?</\1>|<[^>]*>", "", page, flags=re.DOTALL) for page in pages]
    for page in words:
        assert re.search(rf"\d{NO_BREAK}(mm|min|%)", page), page
        assert not re.search(r"\d (mm|min|kg|°|%)|(?<![\w.])-0\.?0*\b", page), page
    (seat,) = trainer.get(f"{one}/live").json()["seats"]
    assert seat["for_"] == f"for 4{NO_BREAK}min"
