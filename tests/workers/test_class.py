"""A class at the pendant: lessons in the list, helps taken away, hints, what everybody does, scores under his name."""

import time

import pytest

from app.classroom.working import STUCK
from app.screens._training import scoring
from app.session import Store
from app.training.exercise import exercise
from app.training.score import ScoreCard
from app.workers.hub import Hub
from tests.desk import Desk, until


@pytest.fixture
def hub(tmp_path, patient):
    hub = Hub(Store(tmp_path), robot="ur10e", linger=30.0)
    yield hub
    hub.close()


@pytest.fixture
def at(hub):
    trainer = hub.room.people.add("tim", "Tim", "trainer", "a long password")
    return hub.room.people.classes.make("Monday", trainer.id)


def join(hub, at, name="Ada"):
    return hub.room.people.join(at.code, name, "736251", "127.0.0.1")


def sit(hub, person):
    desk = Desk(hub.enter(person.owner, None, person))
    hub.arrive(desk.live, desk)
    desk.drive.override = 1.0
    desk.idle()
    return desk


def seen(hub, person, now=None):
    """What is kept of somebody after one more look."""
    hub.attending.look(now)
    return hub.room.presences.of([person.owner]).get(person.owner)


def test_a_lesson_stands_first_and_is_chosen_and_nobody_types_a_name(hub, at):
    hub.room.assignments.give(at.id, "bent_tip")
    desk = sit(hub, join(hub, at))
    training = desk.view("choose")
    assert training.chosen.key == "bent_tip" and "lesson" in training._list.options[0]
    assert not training._name.visible


def test_helps_that_class_or_lesson_take_away_are_gone_while_it_runs(hub, at):
    hub.room.assignments.give(at.id, "first_tool", without=["touch"])
    hub.room.assignments.forbid(at.id, ["distance"])
    desk = sit(hub, join(hub, at))
    desk.does(desk.view("choose")._start)
    assert not desk.context.aids.touch and not desk.context.aids.distance and desk.context.aids.closeup
    desk.does(lambda: desk.view("choose")._give_up())
    assert desk.context.aids.touch


def test_a_score_stands_under_the_person_whatever_a_journal_says(hub, at):
    ada = join(hub, at)
    hub.room.assignments.give(at.id, "first_tool")
    desk = sit(hub, ada)
    desk.does(desk.view("choose")._start)
    desk.finish()
    assert [card.exercise for card in hub.records.history(ada.id)] == ["first_tool"]


def test_the_score_card_leads_on_to_what_the_class_has_given_next(hub, at):
    """It led to the same exercise with less help, while the page of lessons named another one."""
    ada = join(hub, at)
    for key in ("first_tool", "bent_tip"):
        hub.room.assignments.give(at.id, key)
    desk = sit(hub, ada)
    figures = {"tool_mm": 0.1}
    card = ScoreCard("first_tool", 1, time.time(), 60.0, 90.0, (), figures, {}, "", 0, "", 0, level="guided")
    hub.records.add(ada.id, desk.context.session.name, card)
    assert card.passed
    desk.does(lambda: scoring.show(desk.context, ada.id, card))
    title = exercise("bent_tip").said("en").title
    (following,) = [label for label in desk.shown() if label.startswith("Next: ")]
    assert following == f"Next: {title} (guided)"
    desk.press(following)
    assert desk.state.running.begun.exercise == "bent_tip"


def test_an_attempt_taken_in_from_elsewhere_earns_nothing(hub, at):
    """A journal somebody else made, or a copy of another's session, is finished and shown, and is no score of his."""
    ada, bo = join(hub, at), join(hub, at, "Bo")
    desk = sit(hub, ada)
    desk.does(desk.view("choose")._start)
    name = desk.context.session.name
    copy = hub.store.take(hub.store.recorded(name))
    hub.owners.give(copy, bo.owner)
    other = sit(hub, bo)
    assert other.context.session.name == copy and other.state.running is not None
    other.finish()
    assert not hub.records.history(bo.id) and not hub.records.history(ada.id)
    other.does(other.view("choose")._start)  # his own, in the same session, counts
    other.finish()
    assert len(hub.records.history(bo.id)) == 1


def test_a_class_deleted_under_a_running_lesson_loses_nothing(hub, at):
    ada = join(hub, at)
    hub.room.assignments.give(at.id, "first_tool", without=["touch"])
    desk = sit(hub, ada)
    desk.does(desk.view("choose")._start)
    hub.room.people.classes.delete(at.id)
    hub.room.assignments.forget(at.id)
    assert not desk.context.aids.touch
    desk.finish()
    assert (
        len(hub.records.history(ada.id)) == 1 and desk.said[0] == "warning"
    )  # nothing was done yet: not passed
    assert desk.view("choose")._list.options  # the shipped ones are still there


def test_what_somebody_does_is_kept_and_stuck_is_seen_after_three_minutes(hub, at):
    ada = join(hub, at)
    hub.room.assignments.give(at.id, "first_tool")
    desk, now = sit(hub, ada), time.monotonic()
    assert seen(hub, ada, now).state == "waiting"
    desk.does(desk.view("choose")._start)
    working = seen(hub, ada, now + 1.0)
    assert (working.state, working.exercise, working.points) == ("working", "first_tool", 4)
    assert seen(hub, ada, now + 1.0 + STUCK).state == "stuck"
    desk.does(desk.live.stop)
    assert seen(hub, ada, now + 2.0 + STUCK).state == "stopped"
    desk.does(desk.live.release)
    desk.finish()
    assert seen(hub, ada, now + 3.0 + STUCK).state == "finished"
    hub.depart(desk.live, desk)
    assert seen(hub, ada, now + 4.0 + STUCK).state == "away"


def test_a_hint_stands_on_the_page_until_it_is_put_away_and_the_next_follows(hub, at):
    ada = join(hub, at)
    desk = sit(hub, ada)
    for words in ("Tilt more.", "Look from two sides."):
        hub.room.hints.send("tim", ada.owner, words)
    hub.attending.look()
    read = desk.live.read()
    assert (read.hinted, read.hints) == ("Tilt more.", 2)
    desk.live.hints.got(read.hint)
    desk.context.say("info", "something else")
    assert desk.live.read().hint == read.hint and hub.room.hints.of(ada.owner)[1].shown
    desk.live.hints.put_away(read.hint)
    hub.attending.look()
    read = desk.live.read()
    assert (read.hinted, read.hints) == ("Look from two sides.", 1)
    desk.live.hints.put_away(read.hint)
    assert desk.live.read().hint == 0
    assert all(hint.put_away >= hint.shown > 0 for hint in hub.room.hints.of(ada.owner))


def test_a_hint_survives_a_session_that_is_opened_anew(hub, at):
    ada = join(hub, at)
    sit(hub, ada)
    hub.room.hints.send("tim", ada.owner, "Tilt more.")
    hub._forget(hub.lives[0].session.name)
    desk = sit(hub, ada)
    hub.attending.look()
    assert desk.live.read().hinted == "Tilt more."


def test_who_is_in_no_class_is_not_looked_at(hub, at):
    somebody = hub.room.people.add("eve", "Eve", "trainee", "a long password")
    sit(hub, somebody)
    assert seen(hub, somebody) is None


def test_looking_goes_on_by_itself_and_stops_with_the_server(hub, at):
    ada = join(hub, at)
    sit(hub, ada)
    hub.attending.start()
    until(lambda: hub.room.presences.of([ada.owner]), "a look")
    hub.close()
    assert not hub.attending._thread.is_alive()
