"""The keyboard as viser hands it on, presses and repeats without a release: motion ends by itself all the same."""

import time

import numpy as np
import pytest

from app.pendant.jogging import INCREMENTS, TURN_SPEED
from app.pendant.panels._jog.keys import KEY_SILENCE
from tests.pendant.test_server import until

pytestmark = pytest.mark.xdist_group("pendant_server")

FIRST_REPEAT_S = 0.5  # as most keyboards wait
TICKS_S = 0.25  # what a busy machine may add to a silence
ONE = INCREMENTS["large"][1]


@pytest.fixture
def keyboard(seat):
    """(a hand at the keys, its pendant), the enabling switch on."""
    hand, pendant, _ = seat
    pendant.jogging.enabled, pendant.jogging.override = True, 0.5
    return hand, pendant


def hold(hand, key, repeats):
    """A key held down: the press, nothing while the keyboard waits, then repeats."""
    hand.key(key)
    time.sleep(FIRST_REPEAT_S)
    hand.key(key, repeats)


def stands(pendant):
    """Waits until the arm stands; how long that took [s]."""
    begun = time.monotonic()
    until(lambda: not pendant.worker.running("jog"), "the arm to stand")
    return time.monotonic() - begun


def test_a_press_without_a_release_is_a_motion_that_ends_by_itself(keyboard):
    hand, pendant = keyboard
    start = pendant.q.copy()
    hand.key("P")
    until(lambda: pendant.worker.running("jog"), "the motion")
    assert stands(pendant) < KEY_SILENCE + TICKS_S
    moved = pendant.q - start
    assert 0.0 < moved[0] <= 0.5 * TURN_SPEED * (KEY_SILENCE + TICKS_S) and not moved[1:].any()
    at = pendant.q.copy()
    time.sleep(KEY_SILENCE)
    assert np.array_equal(pendant.q, at)


def test_a_held_key_moves_on_and_the_arm_stands_when_its_repeats_end(keyboard):
    hand, pendant = keyboard
    start = pendant.q[0]
    hold(hand, "M", 15)
    assert pendant.worker.running("jog")
    assert stands(pendant) < KEY_SILENCE + TICKS_S
    longest = KEY_SILENCE + 15 * 0.033 + KEY_SILENCE + 2 * TICKS_S
    assert 0.5 * TURN_SPEED * 15 * 0.02 < start - pendant.q[0] <= 0.5 * TURN_SPEED * longest


def test_a_held_key_is_one_increment_and_three_presses_are_three(keyboard):
    hand, pendant = keyboard
    pendant.jogging.increment, pendant.jogging.override = "large", 1.0
    start = pendant.q[0]
    hold(hand, "P", 15)
    assert pendant.worker.idle()
    assert pendant.q[0] - start == pytest.approx(ONE, abs=1e-6)
    time.sleep(0.8)
    hand.key("P", 3, every=0.3)
    assert pendant.worker.idle()
    assert pendant.q[0] - start == pytest.approx(4 * ONE, abs=1e-6)
    hand.key("M")  # the other way needs no pause
    until(lambda: pendant.q[0] - start == pytest.approx(3 * ONE, abs=1e-6), "the way back")


def test_digits_choose_the_axis_and_one_that_is_not_there_moves_nothing(keyboard):
    hand, pendant = keyboard
    pendant.jogging.increment = "large"
    start = pendant.q.copy()
    hand.key("3")
    hand.key("P")
    until(lambda: pendant.q[2] - start[2] == pytest.approx(ONE, abs=1e-6), "axis 3")
    assert pendant.worker.idle() and not np.delete(pendant.q - start, 2).any()
    assert "7" not in hand.keys  # this arm has six


def test_keys_move_nothing_unless_enabled_and_escape_latches(keyboard):
    hand, pendant = keyboard
    pendant.jogging.enabled = False
    start = pendant.q.copy()
    hand.key("P", 3)
    time.sleep(0.2)
    assert pendant.worker.idle() and np.array_equal(pendant.q, start)
    pendant.jogging.enabled = True
    hand.key("P")
    until(lambda: pendant.worker.running("jog"), "the motion")
    hand.key("escape")
    until(lambda: pendant.jogging.stopped, "the stop")
    assert pendant.worker.idle()
    at = pendant.q.copy()
    hand.key("P", 3)
    time.sleep(0.2)
    assert pendant.worker.idle() and np.array_equal(pendant.q, at)
