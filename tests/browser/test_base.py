"""Two robots around a tracker, done by a person: freely, and as exercises; both are read out while they move."""

import numpy as np
import pytest

from app.training.tracker import tracker_truth
from app.units import from_mm, mm

pytestmark = pytest.mark.browser

NEAR_M, SIGMAS = from_mm(1.0), 4.0
DEGREES_APART = 20.0
EXERCISES = {"two_robots": "nothing", "tracker_was_moved": "tracker_moved"}


def test_a_person_finds_where_the_second_robot_stands_and_both_tools_meet(sit_down, brisk):
    person = sit_down("irb120")
    person.screen("base")
    person.click("Open the cell")
    person.reads("base-plan", "Robot 1")
    person.picture("base_1_cell")
    view = person.view("run")
    person.page.get_by_label("Degrees between points", exact=True).fill(f"{DEGREES_APART:g}")
    person.page.get_by_label("Degrees between points", exact=True).press("Enter")
    person.click("Run this step")
    with person.holding():
        person.until(lambda: view.run.wizard.index == 1, "the first step")
        person.at_rest()
    person.click("Run the whole procedure")
    before = person.live.read().axes[0].value
    with person.holding():
        person.until(lambda: person.live.read().axes[0].value != before, "the read-outs to follow")
        assert not person.live.read().own
        person.until(lambda: view.run.relation is not None, "the relation")
        person.at_rest()
    person.reads("base-relation", "X")
    person.moves("Send both tools to one point")
    person.until(lambda: view.run.meeting is not None, "the meeting")
    person.reads("base-miss", "mm")
    person.picture("base_2_met")
    meeting = view.run.meeting
    assert meeting.miss < min(NEAR_M, SIGMAS * meeting.predicted)
    assert f"{mm(meeting.miss):.3f}" in person.seen("base-miss")
    person.click("Close the cell")
    person.until(lambda: person.live.read().own, "the own arm")
    assert not person.faults


@pytest.mark.parametrize("key", EXERCISES)
def test_an_exercise_with_two_robots_is_done_with_its_task_in_sight(sit_down, brisk, key):
    person = sit_down("irb120")
    answer = EXERCISES[key]
    person.screen("training")
    title = next(t for t, e in person.view("showing")._titles.items() if e.key == key)
    person.choose("Exercise", title)
    person.until(lambda: person.context.exercise == key, "the choice")
    person.click("Begin")
    person.until(lambda: person.state.running is not None and person.view("run") is not None, "the exercise")
    begun = person.state.running.begun
    person.page.get_by_role(
        "button", name="Run the whole procedure", exact=True
    ).wait_for()  # its screen opens
    person.reads("exercise-progress", "/")
    person.does(lambda: setattr(person.view("run")._every, "value", DEGREES_APART))
    person.click("Run the whole procedure")
    with person.holding():
        person.until(lambda: person.state.running.wizard.step is None, "the procedure")
        person.at_rest()
    person.picture(f"exercise_{key}")
    person.choose(person.context.t("training.answer"), person.context.t(f"training.answer_{answer}"))
    person.click("Finish and score")
    person.reads("score-total", "of 100")
    (card,) = person.context.shelf.records.history(person.context.session.name, key)
    assert f"{card.total:.0f} of 100" in person.seen("score-total")
    truth = tracker_truth(key, begun.seed).cell.T_base1_base2.position
    assert list(card.truth.values()) == pytest.approx(list(mm(truth)), abs=0.01)
    assert ", ".join(f"{v:.2f}" for v in card.truth.values()) in person.seen("score-truth")
    assert card.answer == card.right_answer == answer
    assert card.total > 60.0 and card.figures["relation_mm"] < 2.0
    person.click("Close")
    person.page.get_by_test_id("score-total").wait_for(state="detached")
    assert np.isfinite(card.total) and not person.faults
