"""The enabling switch by a clock of the test's own: held, silent, tripped, stopped."""

import pytest

from app.session.motion.enabling import SILENCE, Enabling


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


def test_nothing_is_live_before_the_first_word(clock):
    assert not Enabling(clock).live


def test_it_is_live_while_words_are_fresh_and_not_a_moment_longer(clock):
    switch = Enabling(clock)
    switch.beat(True)
    clock.now += SILENCE
    assert switch.live
    clock.now += 1e-6
    assert not switch.live and switch.tripped


def test_letting_go_is_no_trip(clock):
    switch = Enabling(clock)
    switch.beat(True)
    switch.beat(False)
    assert not switch.live and not switch.tripped
    clock.now += 10.0
    assert not switch.tripped
    assert switch.beat(True)


def test_a_page_that_wakes_up_with_the_switch_held_moves_nothing(clock):
    switch = Enabling(clock)
    switch.beat(True)
    clock.now += 1.0
    for _ in range(20):
        assert not switch.beat(True)
        clock.now += 0.03
    assert switch.tripped and switch.trips == 1
    assert not switch.beat(False) and not switch.tripped
    assert switch.beat(True)


def test_after_a_trip_the_motion_button_has_to_be_let_go_too(clock):
    switch = Enabling(clock)
    switch.beat(True)
    clock.now += 1.0
    switch.beat(False, anything=True)
    assert not switch.beat(True)
    switch.beat(False)
    assert switch.beat(True)


def test_the_stop_latches_and_its_release_asks_for_a_new_press(clock):
    switch = Enabling(clock)
    switch.beat(True)
    switch.stop()
    assert not switch.live and not switch.beat(True)
    switch.release()
    assert not switch.beat(True), "held all the while: it has to be pressed anew"
    switch.beat(False)
    assert switch.beat(True)


def test_silence_is_short_enough_for_a_fifth_of_a_second():
    from app.session.motion.worker import TICK_HZ

    assert SILENCE + 1.0 / TICK_HZ <= 0.2
