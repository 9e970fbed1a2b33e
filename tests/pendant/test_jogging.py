"""Hold-to-move on the server: enabling, silence, emergency stop, frames, increments, speed."""

import time
from itertools import pairwise

import numpy as np
import pytest

from app.pendant.jogging import INCREMENTS, SILENCE, TIP_SPEED, Jog
from app.pendant.server import PendantServer
from app.session import Store
from app.units import from_mm
from benchmarks._browser import Browser
from tests.pendant.test_server import until

pytestmark = pytest.mark.xdist_group("pendant_server")
STEP_TOLERANCE = from_mm(0.01)


@pytest.fixture
def pendant(tmp_path):
    server = PendantServer(Store(tmp_path), port=0, robot="ur10e")
    browser = Browser(server.port)
    until(lambda: server.pendants and hasattr(server.pendants[0], "page"), "the page")
    assert server.pendants[0].worker.idle()
    yield server.pendants[0]
    browser.close()
    server.stop()


def press(pendant, frame, axis, sign=1, seconds=0.0):
    """Holds a button: a word every 60 ms, as a browser does."""
    end = time.monotonic() + seconds
    while True:
        pendant.jogging.hear(Jog(frame, axis, sign))
        if time.monotonic() >= end:
            break
        time.sleep(0.06)
    assert pendant.worker.idle()


def test_nothing_moves_unless_enabled(pendant):
    before = pendant.q.copy()
    press(pendant, "joint", 0)
    assert np.array_equal(pendant.q, before)
    assert "Enable" in pendant.log[-1][2]


def test_a_held_button_moves_one_joint_until_the_browser_is_silent(pendant):
    pendant.jogging.enabled = True
    before = pendant.q.copy()
    press(pendant, "joint", 2, seconds=0.4)
    moved = pendant.q - before
    assert moved[2] > 0 and not np.delete(moved, 2).any()
    assert np.array_equal(pendant.session.state.q, pendant.q)


def test_silence_stops_the_arm(pendant):
    pendant.jogging.enabled = True
    pendant.jogging.hear(Jog("joint", 0, 1))
    until(lambda: pendant.worker.running("jog"), "the motion")
    until(lambda: not pendant.worker.running("jog"), "the stand-still")
    stands = pendant.q.copy()
    time.sleep(SILENCE)
    assert np.array_equal(pendant.q, stands)


def test_the_emergency_stop_latches_for_every_kind_of_motion(pendant):
    pendant.jogging.enabled = True
    pendant.jogging.hear(Jog("joint", 0, 1))
    until(lambda: pendant.worker.running("jog"), "the motion")
    pendant.jogging.stop()
    assert pendant.worker.idle()
    stands = pendant.q.copy()
    press(pendant, "joint", 0)
    pendant.post(lambda: pendant.go(pendant.model.home + 0.1))
    pendant.post(lambda: pendant.place(pendant.model.home + 0.1))
    pendant.dragging.event("update", pendant.world.tip(pendant.model.home + 0.1))
    assert pendant.worker.idle()
    assert np.array_equal(pendant.q, stands) and not pendant.jogging.enabled
    assert "EMERGENCY" in pendant.log[-1][2]


@pytest.mark.parametrize("frame", ["base", "tool"])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_an_increment_moves_the_tip_by_just_that_along_the_frames_axis(pendant, frame, axis):
    pendant.jogging.enabled, pendant.jogging.increment = True, "large"
    start = pendant.world.tip(pendant.q)
    press(pendant, frame, axis, seconds=0.2)  # held on: still one increment
    end = pendant.world.tip(pendant.q)
    axes = start.rotation if frame == "tool" else np.eye(3)
    assert np.allclose(
        end.position - start.position, INCREMENTS["large"][0] * axes[:, axis], atol=STEP_TOLERANCE
    )


def test_a_turn_keeps_the_tip_where_it_is(pendant):
    pendant.jogging.enabled, pendant.jogging.increment = True, "large"
    start = pendant.world.tip(pendant.q)
    press(pendant, "tool", 5)
    end = pendant.world.tip(pendant.q)
    assert np.allclose(end.position, start.position, atol=STEP_TOLERANCE)
    assert np.degrees(np.arccos((np.trace(start.rotation.T @ end.rotation) - 1) / 2)) == pytest.approx(
        3.0, abs=0.01
    )


def test_the_tip_never_exceeds_the_manual_speed(pendant):
    pendant.jogging.enabled, pendant.jogging.override = True, 1.0
    tips = []
    show = pendant.show

    def watched(q):
        show(q)
        tips.append((time.monotonic(), pendant.world.tip(q).position))

    pendant.show = watched
    press(pendant, "joint", 0, seconds=0.5)
    way = sum(np.linalg.norm(b[1] - a[1]) for a, b in pairwise(tips))
    # The first step belongs to time before the first stamp, so it is no part of the way counted here.
    assert 0 < way <= TIP_SPEED * (tips[-1][0] - tips[0][0] + 0.1)


def test_a_joint_at_its_limit_says_which(pendant):
    pendant.jogging.enabled, pendant.jogging.increment = True, "large"
    q = pendant.q.copy()
    q[1] = pendant.model.upper[1]
    pendant.post(lambda: pendant.place(q))
    press(pendant, "joint", 1)
    assert pendant.log[-1][2] == "Stopped: axis 2 at its limit."
