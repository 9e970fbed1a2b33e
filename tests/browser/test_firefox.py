"""The path in Firefox: to the ghost, touch, record, calculate; the switch held by a key, the stop by Esc."""

import json
import time

import numpy as np
import pytest

from app.session.motion.drive import MOTIONS
from app.units import mm
from tests.browser.firefox import Firefox, firefox_path
from tests.browser.operator import PATIENCE_S

pytestmark = [
    pytest.mark.browser,
    pytest.mark.xdist_group("browser"),
    pytest.mark.skipif(firefox_path() is None, reason="no Firefox: apt-get install firefox-esr"),
]

ESCAPE, SPACE = "\ue00c", " "
GOOD_MM = 1.5
TRIES, AGAIN_S = 10, 4.0


@pytest.fixture(scope="module")
def firefox():
    browser = Firefox(firefox_path())
    yield browser
    browser.close()


def until(true, what):
    end = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < end, f"waited {PATIENCE_S:g} s for {what}"
        time.sleep(0.05)


def press(firefox, label):
    """A button that is seen, by its words."""
    seen = f"""[...document.querySelectorAll('#work button')].find(
        (one) => one.textContent === {json.dumps(label)} && one.checkVisibility() && !one.disabled)"""
    # found and marked in one turn of the page: in the next the list may be drawn anew
    until(lambda: firefox.run(f"((one) => Boolean(one && (one.id = 'wanted')))({seen})"), label)
    firefox.click("#wanted")
    firefox.run("document.getElementById('wanted')?.removeAttribute('id'), true")


def presses(firefox, label, done, what):
    """Presses a button until what it is for is done: while the list is drawn, a press may meet what has moved away."""
    for _ in range(TRIES):
        press(firefox, label)
        end = time.monotonic() + AGAIN_S
        while not done() and time.monotonic() < end:
            time.sleep(0.05)
        if done():
            return
    raise AssertionError(f"{TRIES} presses, and not {what}")


def moves(firefox, context, label):
    """Presses a button and holds the switch until the arm has gone there."""
    running = context.worker.running
    for _ in range(TRIES):  # while the list is being drawn, a press may meet what has just moved away
        press(firefox, label)
        end = time.monotonic() + AGAIN_S
        while not any(map(running, MOTIONS)) and time.monotonic() < end:
            time.sleep(0.05)
        if any(map(running, MOTIONS)):
            break
    assert any(map(running, MOTIONS)), (label, context.log[-2:])
    while any(map(running, MOTIONS)):
        firefox.key(SPACE, True)
        until(lambda: not any(map(running, MOTIONS)) or context.drive.enabling.tripped, f"{label} to end")
        firefox.key(SPACE, False)
        time.sleep(0.1)


def test_the_path_leads_to_a_good_tool_in_firefox(firefox, served, brisk):
    before = set(map(id, served.hub.lives))
    firefox.go(served.address)
    until(lambda: firefox.run("document.querySelectorAll('#tabs button').length") == 8, "the tabs")
    live = next(one for one in served.hub.lives if id(one) not in before)
    context = live.context
    context.drive.override = 1.0
    for number in range(1, 5):
        moves(firefox, context, "Go to the ghost")
        moves(firefox, context, "Touch the spike")
        there = lambda n=number: f"touch{n}" in context.session.state.captures  # noqa: E731
        presses(firefox, f"Record Touch {number}", there, f"touch {number}")
    for axis in "XZ":
        moves(firefox, context, f"Move 150 mm along tool +{axis}")
        there = lambda a=axis: a.lower() in context.session.state.captures  # noqa: E731
        presses(firefox, f"Record +{axis} direction", there, f"the stroke {axis}")
    presses(firefox, "Calculate", lambda: context.session.state.result is not None, "the result")
    found, true = context.session.state.result.result.tool_point, context.world.T_flange_tool_true.position
    assert mm(float(np.linalg.norm(found - true))) < GOOD_MM
    firefox.key(ESCAPE, True)
    firefox.key(ESCAPE, False)
    until(lambda: context.drive.enabling.stopped, "the stop")
    until(lambda: firefox.run("document.getElementById('estop').className") == "latched", "the latched stop")
