"""Who is stuck: nothing in the lesson got further for three minutes, whatever moves."""

import numpy as np
import pytest

from app.classroom.working import FARTHER, NEARER, STUCK, TURNED, Glance, Watch
from app.geometry import exp_so3
from app.session.actions import Calculate, Comment, Delete, Move, Record, Undo

AT_HOME = {"rotation": np.eye(3), "position": np.zeros(3), "distance": 0.4}


def glance(at, new=(), **changes):
    usual = {
        "page": True,
        "stopped": False,
        "exercise": "first_tool",
        "finished": False,
        "new": tuple(new),
        **AT_HOME,
    }
    return Glance(at=at, **{**usual, **changes})


def turned(angle):
    return exp_so3(np.array([angle, 0.0, 0.0]))


@pytest.fixture
def watch():
    watch = Watch()
    assert watch.see(glance(1.0)) == "working"
    return watch


def test_three_minutes_without_anything_are_stuck_and_since_when_is_known(watch):
    assert watch.see(glance(1.0 + STUCK - 0.1)) == "working"
    assert watch.see(glance(1.0 + STUCK)) == "stuck" and watch.since == 1.0
    assert watch.see(glance(1.0 + 2 * STUCK)) == "stuck" and watch.since == 1.0


@pytest.mark.parametrize("action", [Record("touch1"), Calculate()])
def test_what_adds_to_the_lesson_ends_it(watch, action):
    watch.see(glance(200.0))
    assert watch.see(glance(201.0, [action])) == "working" and watch.since == 201.0
    assert watch.see(glance(201.0 + STUCK)) == "stuck"


@pytest.mark.parametrize("action", [Move((0.0,) * 6), Undo(), Delete("touch1"), Comment("touch1", "hm")])
def test_what_adds_nothing_does_not(watch, action):
    assert watch.see(glance(1.0 + STUCK, [action])) == "stuck"


def test_coming_nearer_than_ever_since_the_last_point_is_work(watch):
    assert watch.see(glance(1.0 + STUCK, distance=0.4 - 2 * NEARER)) == "working"
    assert watch.see(glance(1.0 + 2 * STUCK, distance=0.4 - 3.1 * NEARER)) == "working"


def test_jogging_to_and_fro_is_not(watch):
    for k in range(100):
        state = watch.see(glance(2.0 + 2.0 * k, distance=0.4 + 0.05 * (k % 2)))
    assert state == "stuck"


def test_another_orientation_is_work_the_same_two_again_are_not(watch):
    assert watch.see(glance(100.0, rotation=turned(1.1 * TURNED))) == "working"
    for k in range(100):
        state = watch.see(glance(101.0 + 2.0 * k, rotation=turned(1.1 * TURNED * (k % 2))))
    assert state == "stuck"


def test_turning_the_hand_about_without_end_is_stuck_too(watch):
    for k in range(18):
        state = watch.see(glance(2.0 + 30.0 * k, rotation=turned(1.1 * TURNED * k)))
    assert state == "stuck"


def test_a_way_to_a_turned_touch_counts_though_it_began_farther_off(watch):
    watch.see(glance(10.0, distance=0.001))
    watch.see(glance(100.0, distance=0.2, rotation=turned(1.5 * TURNED)))
    assert watch.see(glance(100.0 + STUCK, distance=0.1, rotation=turned(1.5 * TURNED))) == "working"


def test_a_stroke_leads_away_from_the_spike_and_is_work(watch):
    far = np.array([0.0, 0.0, 2 * FARTHER])
    assert watch.see(glance(1.0 + STUCK, position=far)) == "stuck"
    assert watch.see(glance(2.0 + STUCK, position=far, stroke=True)) == "working"


def test_away_stopped_finished_and_waiting_come_before_stuck(watch):
    late = 1.0 + STUCK
    assert watch.see(glance(late, page=False)) == "away"
    assert watch.see(glance(late, stopped=True)) == "stopped"
    assert watch.see(glance(late, exercise="", finished=True)) == "finished"
    assert watch.see(glance(late, exercise="")) == "waiting"
    assert watch.see(glance(late)) == "stuck"
