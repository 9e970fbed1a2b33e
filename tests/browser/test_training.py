"""A person at exercises, demonstrations and old sessions, in a browser."""

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.units import from_deg

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

TILTS = ((0, 0, 0), (40, 0, 20), (-35, 10, -30), (0, 40, 40))


def training(person):
    """The screen; None while the page is being made anew."""
    return next((view for view in person.pendant.page.views if hasattr(view, "showing")), None)


def stand_tilted(person, tilt):
    """The person has turned the tool another way near the spike; the touch itself is pressed on the page."""
    pendant = person.pendant
    world, home = pendant.world, pendant.model.home
    turned = world.hand(home).rotation @ exp_so3(from_deg(np.array(tilt, float)))
    aim = Pose.of(turned, world.p_base_spike_drawn + np.array([0.0, 0.0, 0.03]))
    q = solve_ik(pendant.model, aim, home, T_flange_tool=world.T_flange_tool_hand, max_steps=300).q
    pendant.post(lambda: pendant.go(q))
    person.at_rest()


def touch_and_record(person, number):
    stand_tilted(person, TILTS[number - 1])
    person.click("Touch the spike")
    person.until(lambda: person.pendant.world.touching(person.pendant.q), "the touch")
    person.at_rest()
    person.click("Record", row=f"○ Touch {number}")
    person.until(lambda: f"touch{number}" in person.state.captures, f"touch {number}")


def test_an_exercise_from_start_to_score_with_a_reload_in_the_middle(serve, sit_down):
    server = serve(robot="jby50")
    person = sit_down(server)
    person.tab("Training")
    field = person.row("Your name").locator("input")
    field.fill("Ada")
    field.press("Enter")
    person.until(lambda: person.pendant.trainee == "Ada", "the name")
    title = next(t for t, e in training(person)._titles.items() if e.key == "first_tool")
    person.page.get_by_label("Exercise", exact=True).click()
    person.page.get_by_role("option", name=title, exact=True).click()
    person.until(lambda: person.pendant.exercise == "first_tool", "the choice")
    person.picture("training_1_list")
    person.click("Begin")
    person.until(lambda: person.state.running is not None, "the exercise")
    person.at_rest()
    secret = person.pendant.world.T_flange_tool_true.position

    touch_and_record(person, 1)
    touch_and_record(person, 2)
    name, before = person.pendant.session.name, person.pendant
    person.page.reload()
    person.until(lambda: server.pendants and server.pendants[-1] is not before, "the page to come back")
    person.pendant = server.pendants[-1]
    person.page.get_by_text("● Touch 2", exact=True).wait_for()
    assert person.pendant.session.name == name and person.state.running.begun.exercise == "first_tool"
    assert np.array_equal(person.pendant.world.T_flange_tool_true.position, secret)
    person.close_notice()
    touch_and_record(person, 3)
    touch_and_record(person, 4)
    person.tab("Training")
    person.page.get_by_test_id("exercise-progress").wait_for()
    assert "4 / 4" in person.seen("exercise-progress")
    person.tab("Tool")
    person.click("Calculate")
    person.until(lambda: person.state.result is not None, "the result")
    person.click("Accept", row="This tool")
    person.until(lambda: person.state.tool is not None, "the tool")
    found = person.state.tool.T_flange_tool.position
    person.tab("Training")
    person.picture("training_2_running")
    person.click("Finish and score")
    person.page.get_by_test_id("score-total").wait_for()
    person.picture("training_3_score")
    assert person.state.running is None
    (card,) = person.pendant.shelf.records.history("Ada", "first_tool")
    assert card.total > 60.0 and f"{card.total:.0f} of 100" in person.seen("score-total")
    assert card.figures["tool_mm"] == pytest.approx(1e3 * np.linalg.norm(found - secret), abs=1e-3)
    assert f"{card.figures['tool_mm']:.2f}" in person.seen("score-figures")
    assert ", ".join(f"{v:.2f}" for v in 1e3 * secret) in person.seen("score-truth")
    assert not person.faults


def test_a_demonstration_plays_by_itself_and_ends_with_a_result(serve, sit_down, monkeypatch):
    from app.pendant.screens._training import showing

    monkeypatch.setattr(showing, "_REST", 0.6)
    person = sit_down(serve(robot="ur10e"))  # it brings its own arm
    person.tab("Training")
    view = training(person)
    view.showing._choice.value = next(t for t, m in view.showing._titles.items() if m.key == "touch_zx")
    person.click("Play this mode")
    person.until(lambda: (now := training(person)) is not None and now.showing.playing, "it to play")
    assert person.state.robot == "jby50"
    person.tab("Training")
    person.until(
        lambda: "Step 3 of 6: Touch 3" in training(person).showing._caption.content, "the third step"
    )
    person.until(lambda: "Step 3 of 6: Touch 3" in person.seen("message"), "the caption on the page")
    person.picture("demonstration")
    person.until(lambda: person.state.result is not None, "the result")
    person.until(lambda: not training(person).showing.playing, "the end")
    assert "Done" in training(person).showing._caption.content
    assert not person.faults


def test_an_old_session_is_listed_opened_played_and_exported(serve, sit_down):
    server = serve(robot="ur10e")
    old = sit_down(server)
    old.click("Record", row="○ Touch 1")
    old.until(lambda: "touch1" in old.state.captures, "a point")
    name = old.pendant.session.name
    old.page.close()
    person = sit_down(server)
    person.until(lambda: name not in server.hub.names, "the first browser to be gone")
    person.tab("Sessions")
    person.click("List anew")
    view = next(v for v in person.pendant.page.views if hasattr(v, "_sessions"))
    person.until(lambda: any(s.name == name for s in view._sessions.values()), "the list")
    person.page.get_by_label("Session", exact=True).click()
    label = next(t for t, s in view._sessions.items() if s.name == name)
    person.page.get_by_role("option", name=label, exact=True).click()
    person.page.get_by_test_id("session-facts").wait_for()
    person.until(lambda: view._chosen.name == name, "the choice")
    person.picture("sessions")
    with person.page.expect_download() as download:
        person.click("Export", row="With it")
    assert download.value.suggested_filename == f"session_{name[:8]}.jsonl"
    assert '"do":"record"' in download.value.path().read_text()

    before = person.pendant
    person.click("Open", row="With it")
    person.until(lambda: server.pendants and server.pendants[-1] is not before, "the other session")
    person.pendant = server.pendants[-1]
    person.page.get_by_text("● Touch 1", exact=True).wait_for()
    assert person.pendant.session.name == name

    person.tab("Sessions")
    stands, count = person.pendant.q.copy(), person.state.count
    person.click("Play", row="With it")
    person.page.get_by_text("recorded", exact=False).first.wait_for()
    person.at_rest()
    assert np.array_equal(person.pendant.q, stands) and person.state.count == count
    assert not person.faults
