"""Every motion waits for the enabling switch, keeps to the speed, and is written down where it ends."""

import time
from itertools import pairwise

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.session.motion.pace import LONGEST_TICK, TIP_SPEED, TURN_SPEED
from app.units import from_mm
from tests.desk import until


def test_a_motion_waits_for_the_switch_pauses_with_it_and_ends_where_it_should(desk):
    aim = desk.q + 0.15
    desk.does(lambda: desk.context.go(aim, errand="there"))
    assert desk.drive.how == "waiting" and desk.live.read().errand == "there"
    before = desk.q.copy()
    time.sleep(0.2)
    assert np.array_equal(desk.q, before)
    with desk.holding():
        until(lambda: not np.array_equal(desk.q, before), "the arm to move")
        assert desk.drive.how == "moving"
    at = desk.q.copy()
    time.sleep(0.2)
    assert np.array_equal(desk.q, at) and not np.allclose(at, aim)
    with desk.holding():
        desk.rests()
    assert np.array_equal(desk.q, aim) and np.array_equal(desk.state.q, aim)
    assert desk.drive.how == "standing" and not desk.live.read().errand


def test_a_motion_that_waits_can_be_given_up_and_another_takes_its_place(desk):
    desk.does(lambda: desk.context.go(desk.q + 0.2))
    desk.live.cancel()
    desk.rests()
    before = desk.q.copy()
    with desk.holding():
        time.sleep(0.1)
    assert np.array_equal(desk.q, before)
    desk.does(lambda: desk.context.go(desk.q + 0.2))
    desk.jog("joint", 0, seconds=0.2)
    assert not (desk.q - before)[1:].any()


def test_typed_values_stay_within_the_limits_and_stop_before_what_they_would_hit(desk, brisk):
    upper = np.degrees(desk.context.model.upper[5])
    with desk.holding():
        desk.live.joint(5, float(upper) + 500.0)
        desk.idle()
        desk.rests()
    assert desk.q[5] == pytest.approx(desk.context.model.upper[5])
    with desk.holding():
        desk.live.joint(1, -10.0)  # down into the table
        desk.idle()
        desk.rests()
    assert "would hit" in desk.said[1] or "touches" in desk.said[1] or "presses" in desk.said[1]
    assert np.array_equal(desk.state.q, desk.q)


def test_no_kind_of_motion_exceeds_the_manual_speed(desk):
    tips, show, tool = [], desk.drive.show, desk.drive.points

    def seen(q):
        show(q)
        flange = desk.context.model.forward(q)
        tips.append((time.monotonic(), np.array([flange.apply(p) for p in tool])))

    desk.drive.show = seen
    start = desk.q + np.array([0.5, 0.0, 0.0, 0.0, 0.0, 0.0])
    far = Pose.of(desk.drive.hand(start).rotation, desk.drive.hand(start).position + np.array([0, -0.5, 0.2]))
    for begin in (
        lambda: desk.context.post(lambda: desk.context.go(start + np.array([-0.9, 0, 0, 0, 0, 0]))),
        lambda: desk.live.joint(0, float(np.degrees(desk.q[0])) - 40.0),
        lambda: desk.context.following.event("update", far),
        desk.live.home,
    ):
        desk.place(start)
        tips.clear()
        with desk.holding():
            begin()
            until(lambda: len(tips) > 12, "the arm to move")
            desk.context.following.event("end", far)
            desk.live.cancel()
            desk.rests()
        ways = np.array([np.linalg.norm(b - a, axis=1) for (_, a), (_, b) in pairwise(tips)])
        way = ways.sum(axis=0).max()
        assert 0.0 < way <= TIP_SPEED * (tips[-1][0] - tips[0][0] + LONGEST_TICK)


def test_the_handle_leads_the_arm_while_the_switch_is_held_and_only_then(desk):
    start = desk.drive.hand()
    up = Pose.of(start.rotation, start.position + np.array([0.0, 0.0, from_mm(60.0)]))
    desk.context.following.event("start", start)
    desk.context.following.event("update", up)
    desk.idle()
    time.sleep(0.2)
    assert np.array_equal(desk.drive.hand().matrix, start.matrix)
    assert "enabling switch" in desk.said[1]
    with desk.holding():
        until(lambda: np.allclose(desk.drive.hand().position, up.position, atol=1e-4), "the arm")
        desk.context.following.event("end", up)
        desk.rests()
    assert np.array_equal(desk.state.q, desk.q)


def test_the_handle_turns_the_tool_no_faster_than_it_may(desk):
    start, begun = desk.drive.hand(), time.monotonic()
    aim = Pose.of(exp_so3(np.array([0.0, 0.0, 0.5])) @ start.rotation, start.position)
    with desk.holding():
        desk.context.following.event("update", aim)
        until(lambda: np.allclose(desk.drive.hand().rotation, aim.rotation, atol=1e-3), "the turn")
    assert time.monotonic() - begun >= 0.9 * 0.5 / TURN_SPEED
    desk.context.following.event("end", aim)
    desk.rests()


def test_a_drag_out_of_reach_says_so_and_the_arm_stays_within_its_limits(desk, brisk):
    start = desk.drive.hand()
    far = Pose.of(start.rotation, start.position + np.array([9.0, 0.0, 0.0]))
    with desk.holding():
        desk.context.following.event("update", far)
        until(lambda: desk.said[1].startswith("Stopped:"), "the end of the reach")
        desk.context.following.event("end", far)
        desk.rests()
    assert desk.context.model.within_limits(desk.q)
    assert np.array_equal(desk.state.q, desk.q)


def test_when_the_page_goes_the_arm_stands(desk):
    desk.live.beat(True, 0, 1, 1)
    until(lambda: desk.context.worker.running("jog"), "the motion")
    desk.live.let_go()
    until(lambda: not desk.context.worker.running("jog"), "the stand-still")
    desk.idle()
    assert np.array_equal(desk.state.q, desk.q)
