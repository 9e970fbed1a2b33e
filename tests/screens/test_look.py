"""How the page speaks to one browser: kept there, and the same on every screen."""

import json
from types import SimpleNamespace

import pytest

from app.geometry import rot_x, rot_y, rot_z
from app.geometry.conventions import convention
from app.kinematics import load_robot, robot_names
from app.screens._tool.words import Words
from app.screens.look import Look
from app.screens.spoken import Spoken
from app.texts import text
from app.workers.axes import pairs, turns
from tests.chinese import CHINESE


def _context(language="zh", vocabulary="", robot="jby50"):
    return SimpleNamespace(
        language=language,
        vocabulary=vocabulary,
        model=load_robot(robot),
        spoken=Spoken(),
        t=lambda key, **fields: text(key, language, **fields),
    )


def test_what_the_browser_keeps_is_what_it_gets_back():
    look = Look("zh", "fanuc", "XYZ", dark=True)
    assert Look.read(look.written()) == look
    assert Look.read(None) == Look.read("") == Look()


@pytest.mark.parametrize(
    "kept",
    ["no json", "[1]", '{"language": "xx", "convention": 3, "dark": "yes", "vocabulary": ["abb"]}', "null"],
)
def test_what_the_browser_made_up_counts_as_not_chosen(kept):
    assert Look.read(kept) == Look()
    assert Look.read(json.dumps({"language": "zh", "dark": 7})) == Look("zh")


@pytest.mark.parametrize(
    "maker, names", [("fanuc", "W P R"), ("kuka", "A B C"), ("abb", "RX RY RZ"), ("", "RX RY RZ")]
)
def test_jog_buttons_turn_in_the_makers_words(maker, names):
    found = pairs("base", 6, maker)
    assert [name for _, name in found] == ["X", "Y", "Z", *names.split()]
    assert sorted(axis for axis, _ in found) == list(range(6))


@pytest.mark.parametrize("maker, form", [("fanuc", "XYZ"), ("kuka", "ZYX")])
def test_a_button_moves_the_very_angle_it_is_named_after(maker, form):
    turn = (rot_x, rot_y, rot_z)
    for place, (axis, _) in enumerate(turns(maker)):
        angles = convention(form).from_rotation(turn[axis - 3](0.1))
        assert abs(angles[place] - 0.1) < 1e-12


@pytest.mark.parametrize(
    "robot, vocabulary, first",
    [
        ("ur10e", "", "ur_script"),
        ("iiwa14", "", "kuka_krl"),
        ("r2000ic_165f", "", "fanuc_utool"),
        ("irb120", "", "abb_rapid"),
        ("ur10e", "kuka", "kuka_krl"),
    ],
)
def test_the_own_controllers_format_is_offered_first(robot, vocabulary, first):
    words = Words(_context("en", vocabulary, robot))  # type: ignore[arg-type]
    assert next(iter(words.formats().values())) == first


def test_conventions_formats_and_arms_have_chinese_words_where_they_are_no_names():
    words = Words(_context())  # type: ignore[arg-type]
    assert CHINESE.search(next(t for t, k in words.conventions().items() if k == "quaternion"))
    assert CHINESE.search(next(t for t, k in words.formats().items() if k == "ros_static"))
    assert set(words.formats().values()) == set(Words(_context("en")).formats().values())  # type: ignore[arg-type]
    for robot in map(load_robot, robot_names()):
        said = robot.said("title", "zh")
        assert "class" not in said and "welding" not in said and robot.said("title", "en") == robot.title
