"""Half a number moves nothing: what is typed counts once it rests or something else is done; a drag counts at once."""

import time

import numpy as np
import pytest

from app.pendant.typed import RESTED, Dragged
from app.units import deg
from tests.pendant.test_server import until

pytestmark = pytest.mark.xdist_group("pendant_server")


def heard(*values, every=0.05):
    drag = Dragged()
    return [drag.hears(value, every * k) for k, value in enumerate(values)]


@pytest.mark.parametrize("typed", [(1, 12, 120), (-1, -12, -12.5), (0, 0.5), (57.3, 57, 5, 1, 12, 120)])
def test_typing_is_never_taken_for_a_drag_however_quick(typed):
    assert not any(heard(*typed))


def test_a_drag_is_known_by_its_third_value_and_forgotten_after_a_rest():
    assert heard(10.0, 14.0, 18.0, 22.5, 30.0) == [False, False, True, True, True]
    assert not any(heard(10.0, 14.0, 18.0, 22.5, every=0.5))


def test_a_typed_angle_sends_the_arm_to_the_whole_number_only(seat):
    hand, pendant, shown = seat
    start = float(deg(pendant.q[0]))
    hand.type("Axis 1", 2, 21, 21.5)
    time.sleep(0.5 * RESTED)
    assert not shown
    until(lambda: shown, "the arm to move")
    assert pendant.worker.idle()
    assert np.allclose([a for a in shown if abs(a - start) > 0.01], 21.5), shown


def test_what_is_done_next_finds_the_typed_number_done(seat):
    hand, pendant, _ = seat
    hand.type("Axis 1", 2, 21, every=0.0)
    hand.press("○ Touch 1", "Record")
    until(lambda: "touch1" in pendant.session.state.captures, "the point")
    assert deg(pendant.session.state.captures["touch1"].q[0]) == pytest.approx(21.0)


def test_a_dragged_slider_takes_the_arm_along(seat):
    hand, pendant, shown = seat
    start = float(deg(pendant.q[0]))
    ways = [round(start + k * 1.7, 1) for k in range(1, 9)]
    hand.type("Axis 1", *ways, every=0.05)
    assert len({round(a, 1) for a in shown}) >= len(ways) // 2  # while it was dragged
    assert pendant.worker.idle()
    assert deg(pendant.q[0]) == pytest.approx(ways[-1])


def test_an_emergency_stop_forgets_what_is_typed(seat):
    hand, pendant, shown = seat
    hand.type("Axis 1", 21)
    pendant.jogging.stop()
    assert pendant.worker.idle()
    time.sleep(1.5 * RESTED)
    assert not shown


def test_the_user_frame_is_one_action_however_many_keys_it_took(seat):
    hand, pendant, _ = seat
    count = pendant.session.state.count
    hand.type("X Y Z mm", (1.0, 0.0, 0.0), (12.0, 0.0, 0.0), (120.0, 0.0, 0.0))
    until(lambda: pendant.session.state.user_frame is not None, "the frame")
    assert pendant.session.state.user_frame.position[0] == pytest.approx(0.12)
    assert pendant.session.state.count == count + 1
