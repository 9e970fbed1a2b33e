"""Every mode in every maker's words, driven through the pendant, with angles as that maker shows them."""

import re
from dataclasses import replace

import numpy as np
import pytest

from app.calibration.modes import mode, modes
from app.calibration.vocabularies import vocabularies, vocabulary
from app.geometry import CONVENTIONS, Pose, angle_between
from app.kinematics import load_robot, solve_ik
from app.screens._tool.paper import PAPER, calculate
from app.session.actions import Accept, Calculate, Cancel, ChooseMode, Enter, Record
from app.session.points import load_action
from app.session.state import as_tuple
from app.units import deg, from_mm, mm
from tests.desk import plain

CHINESE = re.compile(r"[\u4e00-\u9fff]")
ROBOT = "r2000ic_165f"  # reaches every pose of the demonstrations
POINT, AXES = 1e-5, 1e-4  # what the inverse kinematics leaves [m, rad]
TYPED = Pose.of(
    CONVENTIONS["ZYX"].to_rotation(np.radians([20.0, 54.3, -10.0])), from_mm(np.array([119.5, 3.0, 352.0]))
)


def joints(flange, near):
    """Joints of the arm that reach a flange pose: from where it stands, else from elsewhere."""
    robot, rng = load_robot(ROBOT), np.random.default_rng(1)
    starts = [near, robot.home, *rng.uniform(robot.lower, robot.upper, (60, robot.joint_count))]
    for start in starts:
        found = solve_ik(robot, flange, start, max_steps=200)
        if found.reached:
            return found.q
    raise AssertionError("the demonstration's pose is out of reach")


@pytest.mark.parametrize("key", [key for key in modes() if key != "direct"])
def test_every_mode_is_walked_through_in_the_pendant_to_its_truth(key, desk):
    demo = mode(key).demo(touches=mode(key).default_touches)
    desk.fresh(robot=ROBOT)
    if "known_tool" in demo.options:  # the tool that is known has been taught and accepted before
        desk.does(lambda: desk.context.do(ChooseMode("direct")))
        desk.does(lambda: desk.context.do(Enter(as_tuple(demo.options["known_tool"]), (0.0, 0.0, 0.0))))
        desk.does(lambda: desk.context.do(Calculate()))
        desk.does(lambda: desk.context.do(Accept("known")))
        desk.does(lambda: desk.context.do(Cancel()))
    desk.does(lambda: desk.context.do(ChooseMode(key)))
    near = load_robot(ROBOT).home
    for step, capture in zip(desk.state.steps, demo.captures, strict=True):
        flange = capture.T_base_flange
        if step.role == "world":  # where the tool stands parallel to the base does not matter
            flange = Pose.of(flange.rotation, np.array([1.5, 0.0, 1.4]))
        near = joints(flange, near)
        action = Record(step.key, as_tuple(near))
        desk.does(lambda action=action: desk.context.do(action))
    desk.does(lambda: desk.tool._compute())
    found = desk.state.result.result.T_flange_tool
    np.testing.assert_allclose(found.position, demo.T_flange_tool.position, atol=50 * POINT)
    assert angle_between(found.rotation, demo.T_flange_tool.rotation) < 50 * AXES
    for value in mm(found.position):
        assert f"{value:.3f}" in desk.read()


@pytest.mark.parametrize("maker", vocabularies())
def test_a_result_stands_in_the_makers_convention_under_the_makers_names(maker, desk):
    words = vocabulary(maker)
    desk.fresh(robot=ROBOT)
    desk.does(lambda: desk.tool.setup._speak(maker))
    desk.does(lambda: desk.context.do(load_action(PAPER, method="pairwise")))
    desk.does(lambda: calculate(desk.context))
    form = CONVENTIONS[words.convention]
    numbers = form.from_rotation(desk.state.result.result.T_flange_tool.rotation)
    said = desk.read()
    assert " ".join(words.angle_names) in said
    assert words.words["en"].mean in said and words.words["en"].max in said
    if form.angular and words.angle_unit == "deg":
        expected = [f"{v + 0.0:.2f}°" for v in np.round(deg(numbers), 2)]
    else:
        expected = [f"{v + 0.0:.5f}" for v in np.round(numbers, 5)]
    assert " ".join(expected) in said


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("maker", ["", *vocabularies()])
def test_every_mode_is_listed_and_the_rows_of_the_makers_own_speak_the_makers_words(maker, language, desk):
    desk.fresh(language, maker, rebuild=True)
    titles = {key: title for title, key in desk.tool.setup._modes.items()}
    assert set(titles) == set(modes())
    if language == "zh":
        assert all(CHINESE.search(title) or title.startswith("TCP") for title in titles.values())
    words = vocabulary(maker) if maker else None
    for key in words.modes if words is not None else modes():
        known = mode(key)
        desk.does(lambda key=key: desk.context.do(ChooseMode(key)))
        assert desk.tool.setup._mode.value == titles[key]
        steps = known.steps(desk.state.touches)
        if words is not None:
            assert titles[key].startswith(words.mode_title(key, known.title, language))
            steps = [words.step(step, language) for step in steps]
        shown = [row.title for row in desk.tool.rows.rows]
        if words is not None or language == "en":
            assert shown == [step.title for step in steps]
        if language == "zh":
            assert all(CHINESE.search(title) for title in shown)
            assert CHINESE.search(plain(desk.tool._next.content).split("：")[-1])


@pytest.mark.parametrize("maker", vocabularies())
def test_direct_entry_takes_numbers_as_the_maker_writes_them(maker, desk):
    words = vocabulary(maker)
    desk.fresh(robot=ROBOT)
    desk.does(lambda: desk.tool.setup._speak(maker))
    desk.does(lambda: desk.context.do(ChooseMode("direct")))
    direct = desk.tool._direct
    assert direct._folder.visible and not desk.tool.setup._touches.visible
    labels = [field.label.split(" [")[0] for field in direct._fields]
    assert labels == ["X", "Y", "Z", *words.angle_names]
    form = CONVENTIONS[words.convention]
    numbers = form.from_rotation(TYPED.rotation)
    degrees = form.angular and words.angle_unit == "deg"
    for field, value in zip(
        direct._fields, [*mm(TYPED.position), *(deg(numbers) if degrees else numbers)], strict=True
    ):
        field.value = float(value)
    desk.does(lambda: desk.tool._compute())
    found = desk.state.result.result.T_flange_tool
    np.testing.assert_allclose(found.matrix, TYPED.matrix, atol=1e-9)
    assert "nothing was measured" in desk.read().lower() and "± 0.000" not in desk.read()
    desk.does(lambda: desk.tool.deciding.accept())
    assert desk.state.tool is not None
    desk.does(lambda: desk.context.do(Cancel()))


def test_typed_numbers_follow_the_convention_that_is_chosen_later(desk):
    desk.fresh(robot=ROBOT)
    desk.does(lambda: desk.context.do(ChooseMode("direct")))
    desk.does(
        lambda: desk.context.do(Enter(as_tuple(TYPED.position), as_tuple(TYPED.quaternion), "quaternion"))
    )
    for key in ("ZYX", "quaternion", "XYZ", "rotvec"):
        desk.context.look = replace(desk.context.look, convention=key)
        desk.does(desk.context.refresh)
        action = desk.tool._direct.action()
        turned = CONVENTIONS[key].to_rotation(np.array(action.angles))
        assert action.convention == key and angle_between(turned, TYPED.rotation) < 1e-5
