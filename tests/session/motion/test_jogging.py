"""Hold to move: enabling, silence, emergency stop, frames, increments, speed."""

import time
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.session.actions import SetUserFrame
from app.session.motion import enabling
from app.session.motion.jogging import INCREMENTS
from app.session.motion.pace import LONGEST_TICK, TIP_SPEED
from app.session.state import Tool
from app.simulation.world import default_tool
from app.units import from_mm
from tests.desk import until

STEP_TOLERANCE = from_mm(0.01)
#: The drawn tool, active: what a trainee has once he has taught it.
TORCH = "torch"


@pytest.fixture
def desk(desk):
    """With the drawn tool active."""
    tool = Tool(TORCH, default_tool(desk.context.model))
    desk.context.session.state = replace(desk.state, tools=(tool,))
    desk.does(desk.context.refresh)
    return desk


def watched(desk):
    """Every pose from now on: (time, tip) each."""
    tips, show = [], desk.drive.show

    def seen(q):
        show(q)
        tips.append((time.monotonic(), desk.context.world.tip(q).position))

    desk.drive.show = seen
    return tips


def test_nothing_moves_unless_the_switch_is_held(desk):
    before = desk.q.copy()
    desk.jog("joint", 0, seconds=0.2, enabled=False)
    assert np.array_equal(desk.q, before)
    assert any("enabling switch" in words for _, _, words in desk.context.log)


def test_a_held_button_moves_one_joint_and_where_it_rests_is_written(desk):
    before = desk.q.copy()
    desk.jog("joint", 2, till=lambda: desk.q[2] > before[2])
    moved = desk.q - before
    assert moved[2] > 0 and not np.delete(moved, 2).any()
    assert np.array_equal(desk.state.q, desk.q)


def test_silence_stops_the_arm_and_a_woken_page_has_to_let_go_first(desk, monkeypatch):
    monkeypatch.setattr(enabling, "SILENCE", 0.16)
    desk.live.beat(True, 0, 1, 1)
    until(lambda: desk.context.worker.running("jog"), "the motion")
    until(lambda: not desk.context.worker.running("jog"), "the stand-still")
    stands = desk.q.copy()
    for _ in range(20):  # the page wakes up with both still held
        desk.live.beat(True, 0, 1, 1)
        time.sleep(0.02)
    assert np.array_equal(desk.q, stands)
    assert any("fell silent" in words for _, _, words in desk.context.log)
    desk.live.beat(False, None, 0, 0)
    desk.live.beat(True, 0, 1, 2)
    until(lambda: not np.array_equal(desk.q, stands), "the arm to move again")


@pytest.mark.parametrize("before", ["nothing", "a jog that has ended"])
def test_where_the_arm_stood_a_silence_is_no_stop(desk, monkeypatch, before):
    """A window that was covered for a moment said "the arm was stopped" to somebody who only held the switch."""
    monkeypatch.setattr(enabling, "SILENCE", 0.3)
    if before != "nothing":
        desk.jog("joint", 2, seconds=0.2)
    desk.live.beat(True, None, 0, 0)
    until(lambda: desk.drive.live, "the switch")
    until(lambda: desk.drive.enabling.tripped, "the silence")
    until(lambda: any("Enabling has ended" in words for _, _, words in desk.context.log), "that it is told")
    assert desk.said[0] == "info"
    assert not any("stopped" in words for _, _, words in desk.context.log)
    desk.live.beat(True, 0, 1, 7)  # pressed without letting go: why nothing moves
    until(lambda: "let go of everything" in desk.said[1], "why nothing moves")
    assert "stopped" not in desk.said[1]
    desk.live.beat(False, None, 0, 0)


def test_from_the_last_word_to_the_last_pose_it_is_never_more_than_a_fifth_of_a_second(desk, monkeypatch):
    monkeypatch.setattr(enabling, "SILENCE", 0.16)
    tips, longest = watched(desk), 0.0
    for number in range(1, 11):
        desk.live.beat(False, None, 0, 0)
        desk.live.beat(True, number % 3, 1, number)
        last = time.monotonic()
        until(lambda: desk.context.worker.running("jog"), "the motion")
        until(lambda: not desk.context.worker.running("jog"), "the stand-still")
        longest = max(longest, tips[-1][0] - last)
    assert 0.0 < longest <= 0.2


@pytest.mark.parametrize("released", ["switch", "button"])
def test_letting_go_of_either_stops_the_arm(desk, released):
    desk.live.beat(True, 0, 1, 1)
    until(lambda: desk.context.worker.running("jog"), "the motion")
    if released == "switch":
        desk.live.beat(False, 0, 1, 1)
    else:
        desk.live.beat(True, None, 0, 0)
    until(lambda: not desk.context.worker.running("jog"), "the stand-still")
    stands = desk.q.copy()
    time.sleep(0.1)
    assert np.array_equal(desk.q, stands)
    desk.live.beat(False, None, 0, 0)


def test_the_emergency_stop_latches_for_every_kind_of_motion(desk):
    desk.live.beat(True, 0, 1, 1)
    until(lambda: desk.context.worker.running("jog"), "the motion")
    desk.live.stop()
    desk.rests()
    stands, context = desk.q.copy(), desk.context
    desk.jog("joint", 0, seconds=0.1)
    aim = context.world.tip(context.model.home + 0.1)
    desk.live.beat(True, None, 0, 0)
    assert not desk.drive.live
    desk.does(lambda: context.go(context.model.home + 0.1))
    desk.does(lambda: context.drive.approach(context.model.home + 0.1))
    context.following.event("update", aim)
    desk.idle()
    assert np.array_equal(desk.q, stands) and desk.drive.how == "stopped"
    assert "EMERGENCY" in desk.said[1]


@pytest.mark.parametrize("frame", ["base", "tool"])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_an_increment_moves_the_tip_by_just_that_along_the_frames_axis(desk, frame, axis):
    desk.context.jogging.increment = "large"
    start = desk.drive.hand()
    desk.jog(frame, axis, seconds=0.4)  # held on: still one increment
    end = desk.drive.hand()
    axes = start.rotation if frame == "tool" else np.eye(3)
    moved = end.position - start.position
    assert np.allclose(moved, INCREMENTS["large"][0] * axes[:, axis], atol=STEP_TOLERANCE)


def test_a_press_that_stutters_is_one_increment_and_the_next_press_is_another(desk):
    desk.context.jogging.increment = "medium"
    before, one = desk.q.copy(), INCREMENTS["medium"][1]
    for _ in range(3):  # the way from the page stalls while the button is held
        desk.live.beat(True, 0, 1, 7)
        desk.rests()
    assert desk.q[0] - before[0] == pytest.approx(one, abs=1e-6)
    desk.live.beat(True, None, 0, 0)
    desk.live.beat(True, 0, 1, 8)
    until(lambda: desk.q[0] - before[0] > 1.5 * one, "the second increment")
    desk.rests()
    assert desk.q[0] - before[0] == pytest.approx(2 * one, abs=1e-6)
    desk.live.beat(False, None, 0, 0)


def test_a_turn_keeps_the_active_tools_point_where_it_is(desk):
    desk.context.jogging.increment = "large"
    start = desk.drive.hand()
    desk.jog("tool", 5)
    end = desk.drive.hand()
    assert np.allclose(end.position, start.position, atol=STEP_TOLERANCE)
    turned = np.degrees(np.arccos((np.trace(start.rotation.T @ end.rotation) - 1) / 2))
    assert turned == pytest.approx(3.0, abs=0.01)


def test_with_the_bare_flange_a_turn_keeps_the_flange_and_the_tip_swings(desk):
    desk.context.session.state = replace(desk.state, tools=())
    desk.context.jogging.increment = "large"
    flange, tip = desk.context.model.forward(desk.q), desk.context.world.tip(desk.q)
    desk.jog("tool", 4)
    assert np.allclose(desk.context.model.forward(desk.q).position, flange.position, atol=STEP_TOLERANCE)
    assert np.linalg.norm(desk.context.world.tip(desk.q).position - tip.position) > from_mm(3.0)


def test_a_joint_at_its_limit_says_which(desk):
    desk.context.jogging.increment = "large"
    q = desk.q.copy()
    q[5] = desk.context.model.upper[5]
    desk.place(q)
    desk.jog("joint", 5)
    assert desk.said[1] == "Stopped: axis 6 at its limit."


def test_a_table_stops_the_tip_before_it_is_hit_and_is_named(desk):
    q, world = desk.q.copy(), desk.context.world
    q[0] += 0.25  # beside the spike, over the table
    desk.place(q)
    desk.jog("base", 2, -1, till=lambda: not desk.context.worker.running("jog"))
    words = desk.said[1]
    assert "would hit the table" in words, words
    height = world.tip(desk.q).position[2] - world.table_height
    assert 0.0 < height < from_mm(60.0)
    desk.live.choose("language", "zh")
    desk.idle()
    desk.jog("base", 2, -1, seconds=0.1)
    assert "工作台" in desk.said[1]
    low = desk.q.copy()
    higher = lambda: world.tip(desk.q).position[2] > world.tip(low).position[2]  # noqa: E731
    desk.jog("base", 2, 1, till=higher)  # away is always free
    assert higher()


def test_contact_with_the_spike_stops_the_tip_on_its_point(desk):
    world = desk.context.world
    above = solve_ik(
        desk.context.model,
        Pose.of(world.tip(desk.q).rotation, world.p_base_spike + np.array([0.0, 0.0, from_mm(30.0)])),
        desk.q,
        T_flange_tool=world.T_flange_tool_true,
    )
    desk.place(above.q)
    desk.drive.override = 0.3
    desk.jog("base", 2, -1, till=lambda: not desk.context.worker.running("jog"))
    assert world.distance(desk.q) < from_mm(0.5)
    assert "touches the spike" in desk.said[1]
    desk.jog("base", 2, -1, seconds=0.2)  # pressed again: it goes no further
    assert world.distance(desk.q) < from_mm(0.5)
    away = lambda: world.distance(desk.q) > from_mm(5.0)  # noqa: E731
    desk.jog("base", 2, 1, till=away)
    assert away()


def test_a_straight_wrist_stops_a_jog_and_says_which_axes(desk):
    q = desk.q.copy()
    q[4] = 0.0  # axes 4 and 6 parallel
    desk.place(q)
    for axis in (3, 4):
        desk.jog("tool", axis, till=lambda: not desk.context.worker.running("jog"))
    said = [words for _, _, words in desk.context.log if "undo each other" in words]
    assert said and "4" in said[0] and "6" in said[0], desk.context.log[-3:]


@pytest.mark.parametrize("axis", [0, 1, 2, 3, 4, 5])
def test_the_user_frame_is_jogged_along_its_own_axes(desk, axis):
    turned = Pose.of(exp_so3(np.array([0.2, -0.3, 0.7])), np.array([0.4, 0.1, 0.2]))
    desk.context.jogging.increment = "large"
    x, y, z = map(float, turned.position)
    a, b, c, d = map(float, turned.quaternion)
    desk.does(lambda: desk.context.do(SetUserFrame((x, y, z), (a, b, c, d))))
    start = desk.drive.hand()
    desk.jog("user", axis)
    end = desk.drive.hand()
    length, angle = INCREMENTS["large"]
    along = turned.rotation[:, axis % 3]
    if axis < 3:
        assert np.allclose(end.position - start.position, length * along, atol=STEP_TOLERANCE)
    else:
        assert np.allclose(end.position, start.position, atol=STEP_TOLERANCE)
        assert np.allclose(end.rotation @ start.rotation.T, exp_so3(angle * along), atol=1e-5)


@pytest.mark.parametrize(
    "frame, axis", [("joint", 0), ("joint", 2), ("base", 1), ("tool", 1), ("user", 1), ("tool", 4)]
)
def test_no_frame_exceeds_the_manual_speed(desk, frame, axis):
    tips = watched(desk)
    desk.jog(frame, axis, seconds=0.5)
    way = sum(np.linalg.norm(b[1] - a[1]) for a, b in pairwise(tips))
    # The first step belongs to time before the first stamp, so it is no part of the way counted here.
    assert 0 < way <= TIP_SPEED * (tips[-1][0] - tips[0][0] + LONGEST_TICK)
    if frame != "joint" and axis < 3:
        points = np.array([p for _, p in tips])
        line = points[-1] - points[0]
        off = np.cross(points - points[0], line / np.linalg.norm(line))
        assert np.abs(off).max() < STEP_TOLERANCE
