"""A person at exercises, demonstrations and old sessions."""

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.units import from_deg

pytestmark = pytest.mark.browser

TILTS = ((0, 0, 0), (40, 0, 20), (-35, 10, -30), (0, 40, 40))


def stand_tilted(person, tilt):
    """The person has turned the tool another way near the spike; the touch itself is pressed on the page."""
    context = person.context
    world, home = context.world, context.model.home
    turned = world.hand(home).rotation @ exp_so3(from_deg(np.array(tilt, float)))
    aim = Pose.of(turned, world.p_base_spike_drawn + np.array([0.0, 0.0, 0.03]))
    q = solve_ik(context.model, aim, home, T_flange_tool=world.T_flange_tool_hand, max_steps=300).q
    with person.holding():
        person.does(lambda: context.go(q))
        person.at_rest()


def touch_and_record(person, number):
    stand_tilted(person, TILTS[number - 1])
    person.moves("Touch the spike")
    assert person.context.world.touching(person.q)
    person.click(f"Record Touch {number}")
    person.until(lambda: f"touch{number}" in person.state.captures, f"touch {number}")


def test_an_exercise_from_start_to_score_with_a_reload_in_the_middle(sit_down, brisk):
    person = sit_down("jby50")
    person.screen("training")
    field = person.page.get_by_label("Your name", exact=True)
    field.fill("Ada")
    field.press("Enter")
    person.until(lambda: person.context.trainee == "Ada", "the name")
    title = next(t for t, e in person.view("showing")._titles.items() if e.key == "first_tool")
    person.choose("Exercise", title)
    person.until(lambda: person.context.exercise == "first_tool", "the choice")
    person.picture("training_1_list")
    person.click("Begin")
    person.until(lambda: person.state.running is not None, "the exercise")
    person.page.get_by_role("button", name="Record Touch 1", exact=True).wait_for()  # its screen opens
    secret = person.context.world.T_flange_tool_true.position
    touch_and_record(person, 1)
    touch_and_record(person, 2)
    name = person.context.session.name
    person.page.reload()
    person.page.locator(".done[data-testid=row-touch2]").wait_for()
    person.come_back()
    assert person.context.session.name == name and person.state.running.begun.exercise == "first_tool"
    assert np.array_equal(person.context.world.T_flange_tool_true.position, secret)
    touch_and_record(person, 3)
    touch_and_record(person, 4)
    person.reads("exercise-progress", "4 / 4")  # beside the work, on the same screen
    person.picture("training_2_running")
    person.click("Calculate")
    person.until(lambda: person.state.result is not None, "the result")
    doubtful = person.state.result.light.colour == "red"
    person.click("Accept")
    if doubtful:
        person.click("Accept anyway?")
    person.until(lambda: person.state.tool is not None, "the tool")
    found = person.state.tool.T_flange_tool.position
    person.page.locator("#strip button.main", has_text="Finish and score").wait_for()
    person.picture("training_4_accepted")
    person.click("Finish and score")
    person.reads("score-total", "of 100")
    person.picture("training_3_score")
    assert person.state.running is None
    (card,) = person.context.shelf.records.history("Ada", "first_tool")
    assert card.total > 60.0 and f"{card.total:.0f} of 100" in person.seen("score-total")
    assert card.figures["tool_mm"] == pytest.approx(1e3 * np.linalg.norm(found - secret), abs=1e-3)
    assert f"{card.figures['tool_mm']:.2f}" in person.seen("score-figures")
    assert list(card.truth.values())[:3] == pytest.approx(list(1e3 * secret), abs=0.01)
    assert ", ".join(f"{v:.2f}" for v in card.truth.values()) in person.seen("score-truth")
    assert not person.faults


def test_a_demonstration_plays_while_the_switch_is_held_and_gives_the_own_points_back(
    sit_down, brisk, monkeypatch
):
    from app.screens._training import showing

    monkeypatch.setattr(showing, "_REST", 0.3)
    person = sit_down("jby50")
    person.click("Record Touch 1")
    person.until(lambda: "touch1" in person.state.captures, "a point of one's own")
    mine = person.state.captures["touch1"]
    person.screen("training")
    title = next(t for t, m in person.view("showing").showing._titles.items() if m.key == "touch_zx")
    person.does(lambda: setattr(person.view("showing").showing._choice, "value", title))
    person.click("Play this mode")
    person.until(lambda: person.view("showing").showing.playing, "it to play")
    person.page.wait_for_timeout(300)
    assert person.context.drive.how == "waiting"
    person.row("touch1").wait_for()  # beside the wizard, on its own screen
    person.click("Next step")
    with person.holding():
        person.until(lambda: person.view("showing").showing.at == 1, "one step")
        person.at_rest()
    person.page.locator("[data-testid=row-touch1] button.pressed").wait_for()
    assert person.view("showing").showing.at == 1  # it waits for the next press
    assert person.page.locator("ol.rows li.done").count() == 1
    person.picture("demonstration")
    person.click("Go on")
    with person.holding():
        person.until(lambda: person.state.result is not None, "the result")
        person.until(lambda: not person.view("showing").showing.playing, "the end")
    person.click("End the demonstration")
    person.until(lambda: list(person.state.captures.values()) == [mine], "the own point")
    assert not person.faults


def test_an_old_session_is_listed_opened_played_and_exported(sit_down, brisk):
    person = sit_down()
    person.click("Record Touch 1")
    person.until(lambda: "touch1" in person.state.captures, "a point")
    name = person.context.session.name
    person.screen("sessions")
    person.unfold("New, files, delete")
    person.click("Begin a new session")
    person.until(lambda: person.live.closed, "the session to be closed")
    person.come_back()
    assert person.context.session.name != name and not person.state.captures
    view = person.view("_rename")
    person.does(view._fill)
    label = next(t for t, (s, _) in view._sessions.items() if s.name == name)
    person.page.get_by_text(label[2:20], exact=False).first.wait_for(state="attached")
    person.choose("Session", label)
    person.until(lambda: view._chosen.name == name, "the choice")
    field = person.page.get_by_label("Name", exact=True).locator("visible=true")
    field.fill("first lesson")
    field.press("Enter")
    person.until(lambda: any("first lesson" in title for title in view._sessions), "the name")
    person.picture("sessions")
    with person.page.expect_download() as download:
        person.click("Export")
    assert download.value.suggested_filename == f"session_{name[:8]}.jsonl"
    assert '"do":"record"' in download.value.path().read_text()
    person.click("Open")
    person.until(lambda: person.live.closed, "the other session")
    person.come_back()
    person.screen("tool")
    person.page.locator(".done[data-testid=row-touch1]").wait_for()
    assert person.context.session.name == name
    person.screen("sessions")
    stands, count = person.q, person.state.count
    person.click("Play")
    with person.holding():
        person.reads("replayed", "recorded")
        person.at_rest()
    assert np.array_equal(person.q, stands) and person.state.count == count
    assert not person.faults
