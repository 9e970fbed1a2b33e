"""What a class has, kept: lessons in order, helps, exercises made here, hints, presence."""

import msgspec
import pytest

from app.classroom import Room
from app.classroom.assignments import MOST
from app.classroom.hints import LONGEST
from app.classroom.made import LARGEST
from app.classroom.presence import GONE, Presence
from app.errors import FileFormatError, InputError, UnknownNameError
from app.session import Store
from app.training import exercise as shelf
from app.training.exercise import exercise, exercise_text
from tests.training.trainee import GOOD


@pytest.fixture
def room(tmp_path):
    return Room(Store(tmp_path).database)


@pytest.fixture
def at(room):
    trainer = room.people.add("tim", "Tim", "trainer", "a long password")
    return room.people.classes.make("Monday", trainer.id)


def join(room, at, name):
    return room.people.join(at.code, name, "736251", "127.0.0.1")


def made(room, **changes):
    return room.made.keep("tim", exercise_text(msgspec.structs.replace(exercise("first_tool"), **changes)))


def test_lessons_stay_in_their_order(room, at):
    ids = [room.assignments.give(at.id, key) for key in ("first_tool", "bent_tip", "heavy_gun")]
    room.assignments.move(at.id, ids[2], -2)
    assert [lesson.key for lesson in room.lessons(at.id)] == ["heavy_gun", "first_tool", "bent_tip"]
    room.assignments.move(at.id, ids[2], 99)
    room.assignments.move(at.id, "of nobody", 1)
    room.assignments.take_away(at.id, ids[1])
    assert [lesson.key for lesson in room.lessons(at.id)] == ["first_tool", "heavy_gun"]


def test_helps_of_class_and_lesson_are_taken_away_together(room, at):
    id = room.assignments.give(at.id, "first_tool", without=["touch", "no such help"])
    room.assignments.forbid(at.id, ["distance"])
    (lesson,) = room.lessons(at.id)
    assert lesson.without == ("distance", "touch") and lesson.own == ("touch",)
    room.assignments.change(at.id, id, without=[], due=5.0)
    (lesson,) = room.lessons(at.id)
    assert lesson.without == ("distance",) and lesson.due == 5.0


def test_a_lesson_of_another_class_is_left_alone(room, at):
    id = room.assignments.give(at.id, "first_tool")
    room.assignments.take_away("another", id)
    room.assignments.change("another", id, due=9.0)
    assert room.lessons(at.id)[0].due == 0.0


def test_a_class_has_each_exercise_once_and_not_too_many(room, at):
    room.assignments.give(at.id, "first_tool")
    with pytest.raises(InputError, match="already"):
        room.assignments.give(at.id, "first_tool")
    for k in range(MOST - 1):
        room.assignments.give(at.id, f"made_{k}")
    with pytest.raises(InputError, match="lessons already"):
        room.assignments.give(at.id, "bent_tip")


def test_seats_have_scores_state_and_what_is_next(room, at):
    ada, bo = join(room, at, "Ada"), join(room, at, "Bo")
    for key in ("first_tool", "bent_tip"):
        room.assignments.give(at.id, key)
    room.records.add(ada.id, "s1", GOOD.scores(exercise("first_tool"), 3))
    room.presences.keep([Presence(bo.owner, "s2", "stuck", 1.0, 2e12)])
    first, second = room.seats(at.id)
    lessons = room.lessons(at.id)
    assert first.person == ada and first.standings[lessons[0].id].tries == 1 and first.now is None
    assert first.next.key == "bent_tip" and second.next.key == "first_tool"
    assert second.now.state == "away"  # seen in another time


def test_presence_that_grows_old_is_away(room):
    room.presences.keep([Presence("o", "s", "working", 1.0, 100.0, "first_tool", 2, 4)])
    room.presences.keep([Presence("o", "s", "stuck", 90.0, 101.0, "first_tool", 2, 4)])
    assert room.presences.of(["o"], 101.0 + GONE)["o"].state == "stuck"
    away = room.presences.of(["o"], 101.1 + GONE)["o"]
    assert away.state == "away" and away.since == 101.0


def test_a_made_exercise_is_found_by_its_key_in_a_program_that_never_met_it(room, monkeypatch):
    kept = made(room, touches=5)
    monkeypatch.setattr(shelf, "_made", {})
    assert room.made.exercise(kept.key).touches == 5
    with pytest.raises(UnknownNameError):
        room.made.exercise("made_nothing")


def test_a_lesson_whose_file_has_a_mistake_says_so_and_the_others_stay(room, at, monkeypatch):
    kept = made(room, touches=5)
    room.assignments.give(at.id, kept.key)
    room.assignments.give(at.id, "first_tool")
    monkeypatch.setattr(shelf, "_made", {})
    monkeypatch.setattr(room.made, "text", lambda key: "touches =")
    broken, good = room.lessons(at.id)
    assert broken.exercise is None and "not an exercise" in broken.problem and "\n" not in broken.problem
    assert good.exercise is not None and broken.title("en") == kept.key


def test_what_is_put_away_stays_a_lesson(room, at):
    kept = made(room, touches=6)
    room.assignments.give(at.id, kept.key)
    room.made.put_away("tim", kept.key)
    assert not room.made.of("tim") and room.lessons(at.id)[0].exercise is not None


def test_a_file_that_is_too_large_or_wrong_is_not_kept(room):
    with pytest.raises(InputError, match="bytes"):
        room.made.keep("tim", "#" * (LARGEST + 1))
    with pytest.raises(FileFormatError):
        room.made.keep("tim", "touches =")
    assert not room.made.of("tim")


def test_a_hint_is_kept_until_it_is_put_away_and_says_when(room):
    room.hints.send("tim", "ada", "  Look\nfrom two sides. ")
    (hint,) = room.hints.waiting(["ada", "bo"])
    assert hint.text == "Look from two sides." and not hint.shown
    room.hints.shown(hint.id, "bo")  # not his
    assert not room.hints.of("ada")[0].shown
    room.hints.shown(hint.id, "ada")
    first = room.hints.of("ada")[0].shown
    room.hints.put_away(hint.id, "ada")
    (after,) = room.hints.of("ada")
    assert after.shown == first > 0 and after.put_away >= first and not room.hints.waiting(["ada"])


@pytest.mark.parametrize("text", ["", " \n ", "x" * (LONGEST + 1)])
def test_a_hint_without_words_or_with_too_many_is_refused(room, text):
    with pytest.raises(InputError, match="hint"):
        room.hints.send("tim", "ada", text)


def test_a_trainee_has_so_many_hints_before_him(room):
    for _ in range(20):
        room.hints.send("tim", "ada", "Tilt more.")
    with pytest.raises(InputError, match="wait for him"):
        room.hints.send("tim", "ada", "Tilt more.")


def test_a_class_is_deleted_with_its_lessons_and_nothing_of_its_members(room, at):
    ada = join(room, at, "Ada")
    room.assignments.give(at.id, "first_tool")
    room.assignments.forbid(at.id, ["touch"])
    room.records.add(ada.id, "s1", GOOD.scores(exercise("first_tool"), 3))
    room.delete(at.id, "tim")
    assert room.people.classes.get(at.id) is None
    assert not room.assignments.of(at.id) and not room.assignments.without(at.id)
    assert room.people.get(ada.id) == ada and room.records.history(ada.id)
    assert ("class_delete", at.id) in {(entry.deed, entry.about) for entry in room.people.audit.read()}
