"""Jogging, dragging and the language switch as a person does them."""

import numpy as np
import pytest

from app.geometry import angle_between
from app.pendant.jogging import INCREMENTS
from app.pendant.texts import TEXTS
from app.pendant.user_frame import user_frame
from app.units import deg, from_mm
from tests.browser.test_life import hold

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

LARGE = INCREMENTS["large"]
STEP_TOLERANCE = from_mm(0.02)
GRIP, ARC = 0.93, 0.62  # shares of the handle's length where an arrow and an arc are gripped


def choose(person, label, option):
    """Takes an option of a list."""
    person.page.get_by_label(label, exact=True).first.click()
    person.page.get_by_role("option", name=option, exact=True).click()
    person.page.wait_for_timeout(100)


def pressed(person, button):
    """One press: the tip before and after it."""
    before = person.pendant.hand()
    q = person.pendant.q.copy()
    hold(person, button, 60)
    person.until(lambda: not np.array_equal(person.pendant.q, q), f"{button} to move the arm")
    person.at_rest()
    return before, person.pendant.hand()


def test_each_frame_is_jogged_by_its_increment_and_keys_work_too(serve, sit_down):
    person = sit_down(serve(robot="ur10e"))
    pendant = person.pendant
    person.tab("Jog")
    person.page.get_by_label("Enable", exact=True).click()
    person.until(lambda: pendant.jogging.enabled, "the switch")
    choose(person, "Step", "10 mm / 3°")
    person.until(lambda: pendant.jogging.increment == "large", "the increment")

    q = pendant.q.copy()
    pressed(person, "J2 −")
    assert deg(pendant.q - q) == pytest.approx([0, -3, 0, 0, 0, 0], abs=1e-6)

    for title, frame, axes in (
        ("Base", "base", lambda tip: np.eye(3)),
        ("Tool", "tool", lambda tip: tip.rotation),
        ("User", "user", lambda tip: user_frame(pendant).rotation),
    ):
        choose(person, "Frame", title)
        person.until(lambda frame=frame: pendant.jogging.frame == frame, "the frame")
        person.page.get_by_role("button", name="RZ +", exact=True).wait_for()
        if frame == "user":
            typed_user_frame(person)
        before, after = pressed(person, "Z −" if frame == "tool" else "Z +")
        along = axes(before)[:, 2] * (-1 if frame == "tool" else 1)
        assert np.allclose(after.position - before.position, LARGE[0] * along, atol=STEP_TOLERANCE), frame
        before, after = pressed(person, "RX +")
        assert np.allclose(after.position, before.position, atol=STEP_TOLERANCE)
        assert angle_between(after.rotation, before.rotation) == pytest.approx(LARGE[1], abs=1e-4)
    person.picture("jog_user_frame")

    person.page.mouse.click(*person.on_page([0.0, 0.0, 2.0]))  # the keys belong to the page, not to a field
    q = pendant.q.copy()
    person.page.keyboard.press("3")
    person.page.keyboard.press("p")
    person.until(lambda: not np.array_equal(pendant.q, q), "the key to move the arm")
    person.at_rest()
    person.page.keyboard.press("Escape")
    person.until(lambda: pendant.jogging.stopped, "the emergency stop by key")
    person.page.get_by_role("button", name="Release the emergency stop", exact=True).wait_for()
    assert not person.faults


def typed_user_frame(person):
    """Turns the user frame by typing into its fields."""
    field = person.row("A B C °").locator("input").first
    field.click(click_count=3)
    person.page.keyboard.type("30")
    field.press("Enter")
    person.until(lambda: person.state.user_frame is not None, "the frame typed in")
    person.until(
        lambda: np.isclose(deg(np.arccos(user_frame(person.pendant).rotation[0, 0])), 30.0), "30 degrees"
    )


def test_the_handle_moves_or_turns_as_chosen_and_all_labels_change_language(serve, sit_down):
    person = sit_down(serve(robot="jby50"))
    person.click("move")
    start = person.pendant.hand()
    length = person.pendant.stage.handle.length
    drag_until_moved(person, [GRIP * length * start.rotation[:, k] for k in (2, 0, 1)])
    moved = person.pendant.hand()
    assert np.linalg.norm(moved.position - start.position) > from_mm(5.0)
    assert angle_between(moved.rotation, start.rotation) < 1e-4

    person.click("turn")
    pairs = ((0, 1), (1, 2), (0, 2))
    arcs = [ARC * length * (moved.rotation[:, a] + moved.rotation[:, b]) / np.sqrt(2.0) for a, b in pairs]
    drag_until_moved(person, arcs)
    turned = person.pendant.hand()
    assert angle_between(turned.rotation, moved.rotation) > 0.005
    assert np.linalg.norm(turned.position - moved.position) < from_mm(1.0)

    english = said_on_all_tabs(person)
    person.tab("Cell")
    choose(person, "Language", "中文")
    person.until(lambda: person.pendant.language == "zh", "the language")
    person.page.get_by_role("tab", name="点动", exact=True).wait_for()
    chinese = said_on_all_tabs(person)
    left = {
        words
        for key, words in TEXTS.languages["en"].items()
        if words in english and words in chinese and TEXTS.languages["zh"].get(key) != words
    }
    assert not left and len(english - chinese) > 40, left
    person.picture("chinese")
    before = person.pendant
    person.page.reload()
    person.until(lambda: any(p is not before for p in person.server.pendants), "the page to come back")
    person.page.get_by_role("tab", name="点动", exact=True).wait_for()
    assert next(p for p in person.server.pendants if p is not before).language == "zh"
    assert not person.faults


def drag_until_moved(person, grips):
    """Grips the handle at one of these places [m, from its origin] after the other until the arm follows."""
    for grip in grips:
        q, hand = person.pendant.q.copy(), person.pendant.hand()
        start = person.on_page(hand.position + grip)
        across = start - person.on_page(hand.position)
        person.drag(start, across, 50)
        person.at_rest()
        if not np.array_equal(person.pendant.q, q):
            return
        across = np.array([-across[1], across[0]])  # an arc is pulled along itself
        person.drag(start, across, 50)
        person.at_rest()
        if not np.array_equal(person.pendant.q, q):
            return
    raise AssertionError("the arm did not follow the handle anywhere")


def said_on_all_tabs(person):
    """Every line of text the page shows, tab by tab."""
    said = set()
    tabs = person.page.get_by_role("tab")
    for number in range(tabs.count()):
        tabs.nth(number).click()
        person.page.wait_for_timeout(250)
        said |= {line.strip() for line in person.page.locator("body").inner_text().splitlines()}
    return said
