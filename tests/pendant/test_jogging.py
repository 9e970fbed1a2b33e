"""Hold-to-move on the server: enabling, silence, emergency stop, frames, increments, speed."""

import time
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.pendant.jogging import INCREMENTS, SILENCE, TIP_SPEED, Jog
from app.pendant.server import PendantServer
from app.session import Store
from app.session.actions import SetUserFrame
from app.session.state import Tool
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


def test_a_press_that_stutters_is_one_increment_and_the_next_press_is_another(pendant):
    pendant.jogging.enabled, pendant.jogging.increment = True, "medium"
    before = pendant.q.copy()
    press(pendant, "joint", 0)
    time.sleep(2 * SILENCE)  # the way from the browser stalls while the button is held
    press(pendant, "joint", 0)
    one = INCREMENTS["medium"][1]
    assert pendant.q[0] - before[0] == pytest.approx(one, abs=1e-6)
    pendant.jogging.let_go()
    press(pendant, "joint", 0)
    assert pendant.q[0] - before[0] == pytest.approx(2 * one, abs=1e-6)


def test_letting_go_stops_the_arm_without_waiting_for_the_silence(pendant, monkeypatch):
    monkeypatch.setattr("app.pendant.jogging.SILENCE", 1e3)
    pendant.jogging.enabled = True
    pendant.jogging.hear(Jog("joint", 0, 1))
    until(lambda: pendant.worker.running("jog"), "the motion")
    pendant.jogging.let_go()
    until(lambda: not pendant.worker.running("jog"), "the stand-still")
    until(lambda: "ready" in pendant.layout._status.content, "the status line to say so")


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
    q[5] = pendant.model.upper[5]
    pendant.post(lambda: pendant.place(q))
    press(pendant, "joint", 5)
    assert pendant.log[-1][2] == "Stopped: axis 6 at its limit."


def test_a_table_stops_the_tip_before_it_is_hit_and_is_named(pendant):
    pendant.jogging.enabled, pendant.jogging.override = True, 1.0
    q = pendant.q.copy()
    q[0] += 0.25  # beside the spike, over the table
    pendant.post(lambda: pendant.place(q))
    press(pendant, "base", 2, -1, seconds=4.0)
    words = pendant.log[-1][2]
    assert "would hit the table" in words, words
    height = pendant.world.tip(pendant.q).position[2] - pendant.world.table_height
    assert 0.0 < height < from_mm(60.0)
    pendant.language = "zh"
    press(pendant, "base", 2, -1)
    assert "工作台" in pendant.log[-1][2]
    low = pendant.q.copy()
    press(pendant, "base", 2, 1, seconds=0.3)  # away is always free
    assert pendant.world.tip(pendant.q).position[2] > pendant.world.tip(low).position[2]


def test_contact_with_the_spike_stops_the_tip_on_its_point(pendant):
    pendant.jogging.enabled, pendant.jogging.override = True, 0.3
    world = pendant.world
    above = solve_ik(
        pendant.model,
        Pose.of(world.tip(pendant.q).rotation, world.p_base_spike + np.array([0.0, 0.0, from_mm(30.0)])),
        pendant.q,
        T_flange_tool=world.T_flange_tool_true,
    )
    pendant.post(lambda: pendant.place(above.q))
    press(pendant, "base", 2, -1, seconds=1.5)
    assert world.distance(pendant.q) < from_mm(0.5)
    assert "touches the spike" in pendant.log[-1][2]
    press(pendant, "base", 2, -1, seconds=0.3)  # pressed again: it goes no further
    assert world.distance(pendant.q) < from_mm(0.5)
    press(pendant, "base", 2, 1, seconds=0.6)
    assert world.distance(pendant.q) > from_mm(5.0)


def test_a_straight_wrist_stops_a_jog_and_says_which_axes(pendant):
    pendant.jogging.enabled, pendant.jogging.override = True, 1.0
    q = pendant.q.copy()
    q[4] = 0.0  # axes 4 and 6 parallel
    pendant.post(lambda: pendant.place(q))
    press(pendant, "tool", 3, seconds=1.0)
    assert "undo each other" in pendant.log[-1][2] or not np.array_equal(pendant.q, q)
    press(pendant, "tool", 4, seconds=1.0)
    said = [words for _, _, words in pendant.log if "undo each other" in words]
    assert said and "4" in said[0] and "6" in said[0], pendant.log[-3:]


@pytest.mark.parametrize("axis", [0, 1, 2, 3, 4, 5])
def test_the_user_frame_is_jogged_along_its_own_axes(pendant, axis):
    turned = Pose.of(exp_so3(np.array([0.2, -0.3, 0.7])), np.array([0.4, 0.1, 0.2]))
    pendant.jogging.enabled, pendant.jogging.increment = True, "large"
    x, y, z = map(float, turned.position)
    a, b, c, d = map(float, turned.quaternion)
    pendant.post(lambda: pendant.do(SetUserFrame((x, y, z), (a, b, c, d))))
    assert pendant.worker.idle()
    start = pendant.world.tip(pendant.q)
    press(pendant, "user", axis)
    end = pendant.world.tip(pendant.q)
    length, angle = INCREMENTS["large"]
    along = turned.rotation[:, axis % 3]
    if axis < 3:
        assert np.allclose(end.position - start.position, length * along, atol=STEP_TOLERANCE)
    else:
        assert np.allclose(end.position, start.position, atol=STEP_TOLERANCE)
        assert np.allclose(end.rotation @ start.rotation.T, exp_so3(angle * along), atol=1e-5)


def test_an_accepted_tool_is_what_is_jogged_about(pendant):
    pendant.jogging.enabled, pendant.jogging.increment = True, "large"
    other = Tool("other", Pose.of(None, np.array([0.05, 0.02, 0.3])))
    pendant.session.state = replace(pendant.session.state, tools=(other,))
    start = pendant.world.shown_flange(pendant.q) @ other.T_flange_tool
    press(pendant, "base", 5)
    end = pendant.world.shown_flange(pendant.q) @ other.T_flange_tool
    assert np.allclose(end.position, start.position, atol=STEP_TOLERANCE)
    assert np.linalg.norm(pendant.world.tip(pendant.q).position - start.position) > from_mm(5.0)


@pytest.mark.parametrize("frame", ["base", "tool", "user"])
def test_no_frame_exceeds_the_manual_speed_and_the_line_is_straight(pendant, frame):
    pendant.jogging.enabled, pendant.jogging.override = True, 1.0
    tips = []
    show = pendant.show

    def watched(q):
        show(q)
        tips.append((time.monotonic(), pendant.world.tip(q).position))

    pendant.show = watched
    press(pendant, frame, 1, seconds=0.5)
    way = sum(np.linalg.norm(b[1] - a[1]) for a, b in pairwise(tips))
    assert 0 < way <= TIP_SPEED * (tips[-1][0] - tips[0][0] + 0.1)
    points = np.array([p for _, p in tips])
    line = points[-1] - points[0]
    off = np.cross(points - points[0], line / np.linalg.norm(line))
    assert np.abs(off).max() < STEP_TOLERANCE
