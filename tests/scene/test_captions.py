"""No words cover others, where a result is looked at, in a window of any shape; the handle hides nothing near by."""

import itertools

import numpy as np
import pytest

from app.kinematics import robot_names
from app.scene import camera
from app.scene.captions import HEIGHT, column, of_axes, of_points, of_result, spread
from app.screens._tool.paper import PAPER
from app.session import Session
from app.session.actions import Calculate
from app.session.points import load_action
from app.simulation.world import default_world
from tests.desk import until

_WIDE = 0.62  # of its height, a letter as the page draws it
_RIM = 0.3  # the same, what is left white around the words


@pytest.fixture(scope="module")
def solved():
    session = Session(robot="jby50")
    session.do(load_action(PAPER, method="pairwise"))
    session.do(Calculate())
    return session.state


def boxes(captions, places, view, aspect, reach, centred=False):
    """Left, right, bottom, top of each caption as the eye sees them; one unit is the window's height."""
    eye, centre = view
    eye = centre + max(1.0, camera._NARROW / aspect) * (eye - centre)
    ahead = (centre - eye) / np.linalg.norm(centre - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    scale = 0.5 / np.tan(camera._FIELD / 2.0)
    for caption, place in zip(captions, places, strict=True):
        seen = place - eye
        depth = seen @ ahead
        x, y, high = (
            scale * (seen @ right) / depth,
            scale * (seen @ up) / depth,
            scale * HEIGHT * reach / depth,
        )
        wide, high = _WIDE * high * len(caption.text) + _RIM * high, (1.0 + _RIM) * high
        left = x - wide / 2 if centred else x
        yield left, left + wide, y - high / 2, y + high / 2


def cover(one, other):
    return one[0] < other[1] and other[0] < one[1] and one[2] < other[3] and other[2] < one[3]


@pytest.mark.parametrize("aspect", [0.6, 1.0, 1.6, 2.4])
def test_no_words_of_a_result_cover_others(solved, aspect):
    world, result = default_world(solved.model), solved.result.result
    reach = float(world.robot.description["reach_m"])
    flange = world.robot.forward(np.array(solved.q)).matrix
    captions = [*of_result(result, misses=True), *of_axes(result, flange)]
    ahead = np.array([*result.p_base[:2], 0.0]) / np.linalg.norm(result.p_base[:2])
    places = column(captions, result.p_base, ahead, reach)
    assert len(captions) == len(result.per_point) + 1 + len(result.cones) == 7
    for name in ("result", "whole", "front"):
        view = {**camera.VIEWS, **camera.MORE_VIEWS}[name](world)
        found = list(boxes(captions, places, view, aspect, reach))
        assert not [pair for pair in itertools.combinations(found, 2) if cover(*pair)], name


def test_where_they_spoke_before_they_did_cover_each_other(solved):
    """The same words at the arrows' ends: what the column is for."""
    world, result = default_world(solved.model), solved.result.result
    captions = of_result(result, misses=True)
    found = list(boxes(captions, [c.about for c in captions], camera.result(world), 1.6, 3.0))
    assert any(cover(*pair) for pair in itertools.combinations(found, 2))


def test_numbers_of_points_do_not_cover_each_other(solved):
    world = default_world(solved.model)
    reach = float(world.robot.description["reach_m"])
    captions, places = of_points(solved.ordered, camera.result(world), reach)
    found = list(boxes(captions, places, camera.result(world), 1.6, reach))
    assert [c.text for c in captions] == list("123456")
    assert not [pair for pair in itertools.combinations(found, 2) if cover(*pair)]
    assert np.abs(places[:, 2] - [c.about[2] for c in captions]).max() < 0.15 * reach


def test_heights_are_spread_no_further_than_they_must_be():
    rng = np.random.default_rng(0)
    for _ in range(50):
        heights = rng.uniform(0.0, 1.0, rng.integers(1, 12))
        found = spread(heights, 0.1)
        order = np.argsort(heights)
        assert np.array_equal(np.argsort(found), order)
        assert np.diff(found[order]).min(initial=1.0) > 0.1 - 1e-9
        assert found.mean() == pytest.approx(heights.mean())
    assert np.allclose(spread([0.0, 1.0, 2.0], 0.1), [0.0, 1.0, 2.0])
    assert np.allclose(spread([0.5, 0.5], 0.2), [0.4, 0.6])
    assert spread([], 0.1).shape == (0,)


def test_the_handle_is_out_of_the_way_in_near_views_until_somebody_asks_for_it(sit_at):
    desk = sit_at(robot="jby50")
    stage = desk.context.stage
    seen = {}
    for name in ("whole", "side", "front", "close", "whole"):
        desk.live.choose("view", name)
        desk.idle()
        seen[name] = stage.handle.visible
    assert seen == {"whole": True, "side": False, "front": False, "close": False}
    desk.live.choose("view", "close")
    desk.live.choose("handle", "shift")
    desk.idle()
    assert stage.handle.visible


@pytest.mark.parametrize("robot", robot_names())
def test_bodies_that_meet_are_coloured_where_they_are(sit_at, robot):
    desk = sit_at(robot=robot)
    met = desk.context.stage.met
    touched = desk.context.world.touch(desk.context.model.home, np.random.default_rng(0))
    assert touched.reached
    desk.place(touched.q)
    assert met.shown == ("touch", ("tool tip", "spike"))
    assert {handle.name.split("/")[1][:3] for handle in met._handles} == {"arm", "cel"}
    assert {tuple(handle.color) for handle in met._handles} == {(30, 170, 80)}
    desk.place(desk.context.model.home)
    assert met.shown is None and met._handles == []


def test_what_stopped_the_arm_is_red_until_it_moves_on(sit_at, brisk):
    desk = sit_at(robot="jby50")
    met = desk.context.stage.met
    down = desk.q.copy()
    down[1] += 1.2
    with desk.holding():
        desk.does(lambda: desk.drive.approach(down))
        desk.rests()
    until(lambda: met.shown is not None, f"the colour; {desk.context.log[-2:]}")
    how, bodies = met.shown
    assert how == "hit" and met._handles
    assert {tuple(handle.color) for handle in met._handles} == {(230, 30, 30)}
    assert bodies == (desk.drive.met.a, desk.drive.met.b)
    desk.jog("joint", 1, -1, seconds=0.3)
    until(lambda: met.shown is None, "the colour to go")
