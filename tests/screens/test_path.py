"""Following the pendant's own proposals leads to a good tool: every arm, and every mode; all of both by `follow`."""

import numpy as np
import pytest

from app.calibration.modes import modes
from app.kinematics import robot_names
from app.session.actions import ChooseMode
from tests.screens.follow import follow, why_not_good

_ROBOTS = robot_names()
#: All arms go the fullest way; each other way is gone by one of them, in turn.
WAYS = [("touch_zx", name) for name in _ROBOTS]
WAYS += [(key, _ROBOTS[k % len(_ROBOTS)]) for k, key in enumerate(modes()) if key != "touch_zx"]
#: Eight touches on the arm whose wrist stands straightest at home: the one that would flip it.
WAYS += [("touch_many", "irb120")]
#: With an origin of its own, on an arm from whose last touch Y was not free either way.
SEEDS = {("six_point_xy", "iiwa7"): 11}
WAYS += list(SEEDS)


@pytest.mark.parametrize("mode, robot", WAYS, ids=lambda v: v)
def test_following_the_proposals_leads_to_a_good_tool(sit_at, brisk, mode, robot):
    desk = sit_at(robot=robot)
    desk.context.rng = np.random.default_rng(SEEDS.get((mode, robot), 3))
    follow(desk, mode)
    assert not why_not_good(desk)


def test_a_point_that_no_free_way_leads_to_is_said_and_nothing_moves(sit_at, brisk, monkeypatch):
    monkeypatch.setattr("app.screens._tool.hand.aims", lambda *asked: iter(()))
    desk = sit_at(robot="ur10e")
    desk.does(lambda: desk.context.do(ChooseMode("plane")))
    before = desk.q.copy()
    desk.moves(desk.view("deciding")._help)
    assert desk.said[0] == "warning" and "no free way" in desk.said[1]
    assert np.array_equal(desk.q, before)


def test_a_plate_in_the_air_is_recorded_with_its_distance(sit_at):
    desk = sit_at(robot="ur10e")
    desk.does(lambda: desk.context.do(ChooseMode("plane")))
    view = desk.view("deciding")
    desk.does(view._record_next)
    assert desk.said[0] == "warning" and "from the plate" in desk.said[1]
    assert view.rows.rows[0].light == "yellow" and view.rows.rows[0].note == "in the air"
