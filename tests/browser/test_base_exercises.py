"""The exercises with a laser tracker as a person does them: begin, run the procedure, answer, finish, the score."""

import pytest

from app.pendant import motion
from app.pendant.screens._base import run
from app.training.tracker import tracker_truth
from app.units import mm
from tests.browser.test_jog_screen import choose

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

DEGREES_APART = 30  # fewer points, so that the test is short
EXERCISES = {"two_robots": "nothing", "tracker_was_moved": "tracker_moved"}


def view_with(person, part):
    """The screen with this part; None while the page is being made anew."""
    return next((view for view in person.pendant.page.views if hasattr(view, part)), None)


def at_tab(person, name, sight):
    """Goes to a tab, once more where the page was made anew for the exercise's robots meanwhile."""
    if not sight.is_visible():
        person.tab(name)
    return sight.is_visible()


def test_both_tracker_exercises_from_start_to_score(serve, sit_down, monkeypatch):
    monkeypatch.setattr(motion, "SHORTEST", 0.03)
    monkeypatch.setattr(motion, "SPEED", 20.0)
    monkeypatch.setattr(run, "_REST", 0.0)
    person = sit_down(serve(robot="irb120"))
    for key, answer in EXERCISES.items():
        person.tab("Training")
        title = next(t for t, e in view_with(person, "showing")._titles.items() if e.key == key)
        if person.pendant.exercise != key:
            choose(person, "Exercise", title)
            person.until(lambda key=key: person.pendant.exercise == key, "the choice")
        person.click("Begin")
        person.until(lambda: person.state.running is not None, "the exercise")
        person.at_rest()
        begun = person.state.running.begun
        person.until(
            lambda: "The tab Two robots has the wizard" in person.pendant.log[-1][2], "where to go on"
        )
        whole = person.page.get_by_role("button", name="Run the whole procedure", exact=True)
        person.until(lambda whole=whole: at_tab(person, "Two robots", whole), "the procedure's button")
        view_with(person, "run")._every.value = DEGREES_APART
        person.click("Run the whole procedure")
        person.until(lambda: person.state.running.wizard.step is None, "the procedure")
        person.at_rest()
        person.picture(f"exercise_{key}")
        person.tab("Training")
        choose(person, person.pendant.t("training.answer"), person.pendant.t(f"training.answer_{answer}"))
        person.click("Finish and score")
        person.page.get_by_test_id("score-total").wait_for()
        (card,) = person.pendant.shelf.records.history(person.pendant.session.name, key)
        assert f"{card.total:.0f} of 100" in person.seen("score-total")
        truth = tracker_truth(key, begun.seed).cell.T_base1_base2.position
        assert ", ".join(f"{v:.2f}" for v in mm(truth)) in person.seen("score-truth")
        assert card.answer == card.right_answer == answer
        assert card.total > 60.0 and card.figures["relation_mm"] < 2.0
        person.click("Close")
        person.page.get_by_test_id("score-total").wait_for(state="detached")
    assert not person.faults
