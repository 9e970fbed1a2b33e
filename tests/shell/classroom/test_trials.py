"""An exercise made in the page is begun at once in its maker's own session: from its fields, a file, or the list."""

import pytest

from app.classroom.making import usual
from app.training.exercise import exercise, exercise_text, parse_exercise
from tests.desk import Desk, until

FIELDS = {
    **usual(),
    "title_en": "The bent torch",
    "task_en": "Teach the torch.",
    "touches": "6",
    "wrong": "bent_tip",
}


def running(hub, trainer):
    """The trainer's session, once an exercise runs in it."""
    desk = Desk(hub.find(trainer.person.owner))
    until(lambda: desk.state.running is not None, "the exercise")
    return desk


@pytest.mark.parametrize("form", [None, usual()["help_distance"]], ids=["without the number", "all helps"])
def test_what_the_fields_say_is_tried_and_not_kept(hub, trainer, form):
    fields = {name: value for name, value in FIELDS.items() if form or name != "help_distance"}
    assert trainer.post("/exercises/new", **fields, do="try").headers["location"] == "/"
    desk = running(hub, trainer)
    begun = desk.state.running.begun
    assert begun.exercise.startswith("made_") and len(desk.state.steps) == 6
    assert desk.context.aids.distance == bool(form)
    assert not hub.room.made.of(trainer.person.id)
    desk.finish()
    assert desk.state.running is None


def test_a_file_is_tried_and_kept_and_given_out_again(hub, trainer):
    written = exercise_text(exercise("first_tool"))
    trainer.post("/exercises/file", text=written, do="try")
    running(hub, trainer)
    assert not hub.room.made.of(trainer.person.id)
    trainer.post("/exercises/file", text=written, do="keep")
    (kept,) = hub.room.made.of(trainer.person.id)
    given = trainer.get(f"/exercises/{kept.key}.toml").text
    assert (
        given == written and parse_exercise(given, "again", "again").touches == exercise("first_tool").touches
    )


def test_one_of_the_list_is_tried(hub, trainer):
    trainer.post("/exercises/new", **FIELDS, do="keep")
    (kept,) = hub.room.made.of(trainer.person.id)
    trainer.post(f"/exercises/{kept.key}", do="try")
    assert running(hub, trainer).state.running.begun.exercise == kept.key


def test_while_another_runs_nothing_is_begun_and_the_page_says_so(hub, trainer):
    trainer.post("/exercises/file", text=exercise_text(exercise("first_tool")), do="try")
    desk = running(hub, trainer)
    before, said = desk.state.running.begun, len(desk.context.log)
    trainer.post("/exercises/new", **FIELDS, do="try")
    until(lambda: len(desk.context.log) > said, "the word that another runs")
    assert desk.state.running.begun == before


def test_a_mistake_in_a_field_begins_nothing(hub, trainer):
    answer = trainer.post("/exercises/new", 400, **{**FIELDS, "bent_mm": "much"}, do="try")
    assert "much" in answer.text and hub.find(trainer.person.owner) is None


def test_a_trainee_tries_nothing(hub, trainer, ada):
    ada.post("/exercises/new", 404, **FIELDS, do="try")
    assert hub.find(ada.person.owner) is None
