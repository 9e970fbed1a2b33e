"""Very many rows: an even choice of them, whole poses and targets at a time."""

import numpy as np
import pytest

from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.observations.thinning import MOST_ROWS, MOST_SESSIONS, MOST_TARGETS, thinned
from app.kinematics import load_robot


def test_few_rows_all_stay():
    keep = np.arange(MOST_ROWS + 5) >= 5
    assert (thinned(keep, np.arange(len(keep)), None) == keep).all()


def test_many_rows_are_taken_evenly_from_beginning_to_end():
    keep = np.ones(100_000, bool)
    taken = np.flatnonzero(thinned(keep, np.arange(100_000), None))
    assert len(taken) == MOST_ROWS
    assert (taken // 10 == np.arange(MOST_ROWS)).all()  # one of every ten


def test_rows_that_repeat_a_pose_stay_together():
    pose = np.repeat(np.random.default_rng(0).permutation(10_000), 5)
    out = thinned(np.ones(50_000, bool), pose, None)
    assert set(np.bincount(pose[out])) <= {0, 5}
    assert abs(out.sum() - MOST_ROWS) < 20


def test_of_very_many_targets_and_sessions_some_stay_whole():
    target = np.repeat(np.random.default_rng(0).permutation(1500), 4)
    out = thinned(np.ones(6000, bool), np.arange(6000), target)
    assert set(np.bincount(target[out])) == {0, 4} and len(set(target[out])) == MOST_TARGETS
    session = np.repeat(np.arange(500), 20)
    out = thinned(np.ones(10_000, bool), np.arange(10_000), None, session)
    assert set(np.bincount(session[out])) == {0, 20} and len(set(session[out])) == MOST_SESSIONS


def test_targets_of_many_touches_keep_some_of_each():
    many = np.arange(40_000) % 8
    out = thinned(np.ones(40_000, bool), np.arange(40_000), many)
    assert out.sum() == MOST_ROWS and set(many[out]) == set(range(8))


def test_rows_that_cannot_be_used_never_come_back():
    keep = np.arange(60_000) % 3 > 0
    assert not (thinned(keep, np.arange(60_000), None) & ~keep).any()


@pytest.mark.parametrize("stated", [False, True], ids=["alone", "with time, load and warmth"])
def test_rows_that_are_left_out_still_say_where_the_others_came_from(stated):
    """Torques are worked out for the rows that are worked on alone: of 400,000 rows they were for all."""
    robot, rng = load_robot("ur10e"), np.random.default_rng(11)
    q = rng.uniform(-1.0, 1.0, (60, robot.joint_count))
    q[20:30, 2] = q[20, 2]
    keep = rng.random(60) < 0.4
    more = {}
    if stated:
        more = {"time": np.arange(60.0) + 5.0, "temperature": rng.random(60), "payload": rng.random(60)}
    whole, some = situation_for(robot, q, **more), situation_for(robot, q, keep=keep, **more)
    names = (
        "q",
        "torque",
        "leaning",
        "moment",
        "approach",
        "move",
        "speed",
        "time",
        "order",
        "temperature",
        "payload",
    )
    for name in names:
        all_, kept = getattr(whole, name), getattr(some, name)
        assert (all_ is None and kept is None) or np.array_equal(all_[keep], kept), name
