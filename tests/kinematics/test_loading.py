"""Robots are found by name or path; what cannot be one is refused in one line."""

import pytest

from app.errors import FileFormatError, InputError, UnknownNameError
from app.kinematics import load_robot, robot_names

JOINT = (
    '<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>'
    "{limit}</joint>"
)
LIMIT = '<limit lower="-1" upper="1" velocity="1" effort="1"/>'


def arm(count, kind="revolute", limit=LIMIT):
    links = "".join(f'<link name="l{k}"/>' for k in range(count + 1))
    joints = "".join(
        JOINT.format(name=f"j{k}", kind=kind, parent=f"l{k}", child=f"l{k + 1}", limit=limit)
        for k in range(count)
    )
    return f'<robot name="r">{links}{joints}</robot>'


def load_text(tmp_path, text):
    path = tmp_path / "arm.urdf"
    path.write_text(text)
    return load_robot(path)


def test_every_shipped_robot_loads_by_its_folder_name():
    assert {"jby50", "ur10e"} <= set(robot_names())
    for name in robot_names():
        assert load_robot(name).name == name


def test_a_misspelt_name_lists_the_names_and_the_nearest():
    with pytest.raises(UnknownNameError, match="did you mean ur10e"):
        load_robot("ur10ee")


def test_a_relative_path_is_tried_beside_the_recording_first(tmp_path):
    (tmp_path / "arm.urdf").write_text(arm(2))
    assert load_robot("arm.urdf", relative_to=tmp_path).joint_count == 2


@pytest.mark.parametrize("count", [1, 8, 9, 24])
def test_arms_of_any_number_of_joints_are_taken(tmp_path, count):
    assert load_text(tmp_path, arm(count)).joint_count == count


def test_a_description_without_a_moving_joint_is_refused(tmp_path):
    with pytest.raises(FileFormatError, match="0 moving joints"):
        load_text(tmp_path, arm(0))


def test_a_continuous_joint_gets_two_turns_either_way(tmp_path):
    robot = load_text(tmp_path, arm(1, "continuous", ""))
    assert robot.upper[0] == pytest.approx(4 * 3.141592653589793)
    assert robot.lower[0] == -robot.upper[0]


@pytest.mark.parametrize(
    "text, problem",
    [
        ("", "not XML"),
        ("\x00\x01", "not XML"),
        ("<html/>", "<html>"),
        ("<robot/>", "no links"),
        (arm(1, limit=""), "has no limits"),
        (arm(1, "floating"), "floating"),
        (arm(2).replace('<parent link="l0"/>', ""), "lacks its parent"),
        (arm(2).replace('<parent link="l0"/>', '<parent link="l2"/>'), "loop"),
    ],
)
def test_what_is_no_arm_is_refused_and_the_file_is_named(tmp_path, text, problem):
    with pytest.raises(FileFormatError) as caught:
        load_text(tmp_path, text)
    assert problem in str(caught.value) and "arm.urdf" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_limit_that_is_no_number_is_named(tmp_path):
    with pytest.raises(InputError, match="limit upper of joint 'j0' is 'far'"):
        load_text(tmp_path, arm(1).replace('upper="1"', 'upper="far"'))


def test_a_file_whose_name_says_nothing_is_called_what_it_calls_its_robot(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(arm(2))
    assert (load_robot(path).name, load_robot(path).title) == ("robot", "r")
    path.write_text(arm(2).replace(' name="r"', ""))
    assert load_robot(path).title == "robot"
    assert load_text(tmp_path, arm(2)).title == "arm"  # a name that somebody gave


def test_meshes_need_not_exist(tmp_path):
    text = arm(1).replace(
        '<link name="l0"/>',
        '<link name="l0"><visual><geometry><mesh filename="package://x/y.stl"/></geometry></visual></link>',
    )
    assert load_text(tmp_path, text).joint_count == 1


FINGERS = "".join(
    f'<link name="finger{k}"/>'
    + JOINT.format(name=f"f{k}", kind="prismatic", parent="hand", child=f"finger{k}", limit=LIMIT)
    for k in (1, 2)
)


@pytest.mark.parametrize("hand", ["tool0", "palm"])
def test_the_fingers_of_a_gripper_are_no_joints_of_the_arm(tmp_path, hand):
    text = (
        arm(3)
        .replace('"l3"', f'"{hand}"')
        .replace("</robot>", FINGERS.replace('"hand"', f'"{hand}"') + "</robot>")
    )
    robot = load_text(tmp_path, text)
    assert (robot.joint_count, robot.flange) == (3, hand)
    assert robot.forward(robot.home).position.shape == (3,)
