"""No words cover others, where a result is looked at, in a window of any shape; the handle hides nothing near by."""

import itertools

import numpy as np
import pytest

from app.kinematics import robot_names
from app.scene import camera
from app.scene.captions import HEIGHT, Caption, column, fitting, of_axes, of_points, of_result, spread
from app.scene.seen import Seen
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


#: Width and height of the scene's window on a desk, a small one, a tablet, a phone [px].
WINDOWS = ((596, 692), (425, 660), (820, 345), (294, 160))
VIEWS = {**camera.VIEWS, **camera.MORE_VIEWS}
READABLE_PX = 12.0


def window(world, name, width, height):
    """What a window of this shape shows in a named view."""
    eye, centre = VIEWS[name](world)
    nearest = camera._NEAREST if name == "whole" else 1.0
    eye = centre + max(nearest, camera._NARROW / (width / height)) * (eye - centre)
    return Seen(eye, centre, camera._FIELD, width, height)


def boxes(captions, places, heights, seen, centred=False):
    """Left, right, bottom, top of each caption as the eye sees them [px]."""
    for caption, height, (x, y, depth) in zip(captions, heights, seen.of(places), strict=True):
        size = seen.pixels(height, depth)
        wide, high = (_WIDE * len(caption.text) + _RIM) * size, (1.0 + _RIM) * size
        left = x - wide / 2 if centred else x
        yield left, left + wide, y - high / 2, y + high / 2


def cover(one, other):
    return one[0] < other[1] and other[0] < one[1] and one[2] < other[3] and other[2] < one[3]


@pytest.mark.parametrize("size", WINDOWS)
def test_no_words_of_a_result_cover_others_and_all_can_be_read(solved, size):
    world, result = default_world(solved.model), solved.result.result
    reach = float(world.robot.description["reach_m"])
    flange = world.robot.forward(np.array(solved.q)).matrix
    captions = [*of_result(result, misses=True), *of_axes(result, flange)]
    assert len(captions) == len(result.per_point) + 1 + len(result.cones) == 7
    for name in VIEWS:
        seen = window(world, name, *size)
        places, heights = column(captions, result.p_base, seen, reach)
        found = list(boxes(captions, places, heights, seen))
        assert not [pair for pair in itertools.combinations(found, 2) if cover(*pair)], name
        assert all(
            seen.pixels(h, d) >= READABLE_PX for h, (_, _, d) in zip(heights, seen.of(places), strict=True)
        )
        edge = np.array(found) / (np.array([size[0], size[0], size[1], size[1]]) / 2)
        assert np.abs(edge).max() <= 1.0, (name, "out of the window")


def test_where_they_spoke_before_they_did_cover_each_other(solved):
    """The same words at the arrows' ends: what the column is for."""
    world, result = default_world(solved.model), solved.result.result
    captions = of_result(result, misses=True)
    seen = window(world, "result", *WINDOWS[0])
    heights = np.full(len(captions), HEIGHT * 3.0)
    found = list(boxes(captions, np.array([c.about for c in captions]), heights, seen))
    assert any(cover(*pair) for pair in itertools.combinations(found, 2))


@pytest.mark.parametrize("size", WINDOWS)
def test_numbers_of_points_cover_neither_each_other_nor_what_stands_there(solved, size):
    world = default_world(solved.model)
    reach = float(world.robot.description["reach_m"])
    for name, taken in itertools.product(VIEWS, ([], [(-60.0, 40.0, -10.0, 30.0), (0.0, 90.0, 35.0, 50.0)])):
        seen = window(world, name, *size)
        captions, places, heights = of_points(solved.ordered, seen, reach, taken)
        found = [*boxes(captions, places, heights, seen, centred=True), *taken]
        covered = [pair for pair in itertools.combinations(found, 2) if cover(*pair)]
        assert not [pair for pair in covered if pair[0] not in taken], name
        away = seen.of(places)[:, 1] - seen.of([c.about for c in captions])[:, 1]
        assert away.max(initial=0.0) < 45.0, "far from what it numbers"
        if size == WINDOWS[0] and not taken and name == "result":
            assert [c.text for c in captions] == list("123456")
        if not taken:
            assert len(captions) >= 3, (name, size)


def test_where_not_all_can_be_read_the_smallest_misses_are_left_out(solved):
    world = default_world(solved.model)
    many = [
        Caption(f"{k}: {k / 10:.2f} mm", np.array([1.0, 0.0, 1.0 + k / 50]), k / 1e4) for k in range(1, 12)
    ]
    many += [Caption("95% ×20", np.array([1.0, 0.0, 1.0]))]
    low, high = window(world, "result", *WINDOWS[3]), window(world, "result", *WINDOWS[0])
    kept = [c.text for c in fitting(many, low)]
    assert kept[-1] == "95% ×20" and kept[-2] == "11: 1.10 mm" and "1: 0.10 mm" not in kept and len(kept) > 6
    places, heights = column(fitting(many, low), np.array([1.0, 0.0, 1.1]), low, 1.4)
    found = list(boxes(fitting(many, low), places, heights, low))
    assert not [pair for pair in itertools.combinations(found, 2) if cover(*pair)]
    assert [c.text for c in fitting(many, high)] == [c.text for c in many]


def test_a_window_gives_back_what_it_was_given():
    seen = Seen(np.array([2.0, -1.0, 1.5]), np.array([0.2, 0.1, 0.5]), 0.75, 820.0, 345.0)
    points = np.random.default_rng(0).uniform(-0.5, 0.5, (20, 3))
    assert np.allclose(seen.at(seen.of(points)), points)
    assert np.allclose(seen.of(seen.centre)[0][:2], 0.0)


def test_words_are_laid_out_anew_for_another_view_and_another_window(sit_at):
    desk = sit_at(robot="jby50")
    context, stage = desk.context, desk.context.stage
    desk.does(lambda: (context.do(load_action(PAPER, method="pairwise")), context.do(Calculate())))
    desk.live.choose("view", "whole")
    desk.idle()
    wide = stage._words.shown[2].max()
    assert desk.live.choose("window", "294 160")
    for no_window in (160, "1 1", "294", "294 160 2", "-294 160", "1e3 160", "99999 160", "²94 160"):
        assert not desk.live.choose("window", no_window), no_window
    desk.idle()
    low = stage._words.shown[2].max()
    assert low > 2.0 * wide  # so many metres are as many pixels in so low a window
    desk.live.choose("view", "close")
    desk.idle()
    assert stage._words.shown[2].max() < 0.5 * low


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
