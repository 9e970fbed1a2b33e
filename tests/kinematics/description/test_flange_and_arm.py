"""Which link is the flange and which joints are the arm, by the rules that are written down, and as it is asked for."""

import numpy as np
import pytest

from app.errors import FileFormatError, InputError, UnknownNameError
from app.kinematics import load_robot
from tests.kinematics.description.making import description, fixed, joint, line, written


def arm_of(tmp_path, joints, choice="", **more):
    return load_robot(f"{written(tmp_path, joints, **more)}{choice}")


@pytest.mark.parametrize(
    "behind, flange",
    [
        ([], "l6"),
        ([fixed("c", "l6", "l6_collision"), fixed("f", "l6", "hand_flange", "0 0 0.1")], "hand_flange"),
        ([fixed("c", "l6", "l6_dummy"), fixed("f", "l6", "end", "0 0 0.1")], "end"),
        ([fixed("s", "l6", "link7_sc"), fixed("f", "l6", "link8", "0 0 0.107")], "link8"),
        ([fixed("k", "l6", "camera_link", "0 0 0.1"), fixed("t", "l6", "tool_frame", "0 0 0.1")], "tool_frame"),
        ([fixed("a", "l6", "palm", "0 0 0.1"), fixed("b", "palm", "finger_tip", "0 0 0.1")], "palm"),
        ([fixed("a", "l6", "flange"), fixed("b", "flange", "tool0")], "tool0"),
        ([fixed("a", "l6", "left_ee_link"), fixed("b", "l6", "stand"), fixed("c", "stand", "plate")], "left_ee_link"),
        ([fixed("a", "l6", "l6_inertia"), fixed("b", "l6_inertia", "l6_mass", "0 0 1")], "l6"),
    ],
)  # fmt: skip
def test_the_flange_is_never_a_stub_a_camera_or_a_finger(tmp_path, behind, flange):
    robot = arm_of(tmp_path, [*line(6), *behind])
    assert (robot.joint_count, robot.flange, robot.base) == (6, flange, "base")


def jaw(parent, name="grip", child="moving_jaw", **more):
    return joint(name, parent, child, xyz="0.02 0 0.03", **more)


@pytest.mark.parametrize(
    "behind, flange",
    [
        ([fixed("t", "l6", "tcp_link", "0 0 0.1"), jaw("l6")], "tcp_link"),
        ([jaw("l6", "gripper", "mover")], "l6"),
        ([fixed("t", "l6", "gripper_frame_link", "0 0 0.1"), jaw("l6", "last", "part")], "gripper_frame_link"),
        ([fixed("h", "l6", "hand"), jaw("hand", "a", "left_finger"), jaw("hand", "b", "right_finger")], "hand"),
        ([jaw("l6", "one", "part_a"), jaw("l6", "two", "part_b", inner='<mimic joint="one"/>')], "l6"),
        ([jaw("l6", "knuckle", "x"), jaw("x", "fingertip_joint", "y")], "l6"),
    ],
)  # fmt: skip
def test_a_moving_jaw_is_no_joint_of_the_arm(tmp_path, behind, flange):
    robot = arm_of(tmp_path, [*line(6), *behind])
    assert (robot.joint_count, robot.flange) == (6, flange)


def test_the_joint_that_turns_a_gripper_stays_with_the_arm(tmp_path):
    joints = [*line(4), joint("roll", "l4", "gripper_link"), fixed("f", "gripper_link", "gripper_frame_link")]
    robot = arm_of(tmp_path, [*joints, fixed("g", "gripper_link", "moving_jaw")])
    assert (robot.joint_count, robot.flange) == (5, "gripper_frame_link")


@pytest.mark.parametrize("branch", [1, 2])
@pytest.mark.parametrize("at", ["base", "l1", "l3"])
def test_a_shorter_branch_does_not_cut_the_arm(tmp_path, branch, at):
    beside = line(branch, base=at, prefix="x")
    assert arm_of(tmp_path, [*beside, *line(6)]).joint_count == 6


def test_a_head_on_the_arm_is_passed_over_even_where_it_is_as_long(tmp_path):
    head = [joint("head_pan", "l4", "head"), joint("head_tilt", "head", "screen")]
    robot = arm_of(tmp_path, [*head, *line(6)])
    assert robot.joint_count == 6 and [j.name for j in robot.joints] == ["j1", "j2", "j3", "j4", "j5", "j6"]


def test_a_hand_of_many_fingers_is_no_arm(tmp_path):
    fingers = [j for k in range(5) for j in line(3 + (k == 0), base="l7", prefix=f"part{k}_")]
    assert arm_of(tmp_path, [*line(7), *fingers]).joint_count == 7


def two_arms():
    torso = joint("waist", "base", "torso")
    return [torso, *line(7, base="torso", prefix="right_"), *line(7, base="torso", prefix="left_"),
            fixed("lt", "left_l7", "left_tool0", "0 0 0.1"), joint("pan", "torso", "head")]  # fmt: skip


def test_two_arms_are_listed_and_the_choice_is_asked_for(tmp_path):
    with pytest.raises(FileFormatError) as caught:
        arm_of(tmp_path, two_arms())
    said = str(caught.value)
    assert "2 arms" in said and "base..right_l7" in said and "base..left_tool0" in said and "--chain" in said


def test_a_chain_and_a_flange_can_be_chosen(tmp_path):
    whole = arm_of(tmp_path, two_arms(), "#flange=left_tool0")
    part = arm_of(tmp_path, two_arms(), "#chain=torso..left_tool0")
    assert (whole.joint_count, whole.base, whole.flange) == (8, "base", "left_tool0")
    assert (part.joint_count, part.base, part.flange) == (7, "torso", "left_tool0")
    q = np.linspace(-1, 1, 7)
    inside = whole.forward(np.concatenate([[0.4], q]))
    at_torso = arm_of(tmp_path, two_arms(), "#flange=torso").forward(np.array([0.4]))
    assert np.allclose((at_torso @ part.forward(q)).matrix, inside.matrix)
    assert load_robot(part.address).forward(q) == part.forward(q)


@pytest.mark.parametrize(
    "choice, problem",
    [
        ("#flange=tool1", "unknown link 'tool1'"),
        ("#flange=base", "0 moving joints"),
        ("#chain=left_l3..right_l5", "not carried by"),
        ("#chain=torso", "BASE..TIP"),
        ("#speed=9", "flange=LINK"),
    ],
)
def test_a_choice_that_cannot_be_is_refused_in_one_line(tmp_path, choice, problem):
    with pytest.raises(InputError) as caught:
        arm_of(tmp_path, two_arms(), choice)
    assert problem in str(caught.value) and "\n" not in str(caught.value)


def test_a_link_that_is_not_there_is_answered_with_those_that_are(tmp_path):
    with pytest.raises(UnknownNameError, match="left_tool0"):
        arm_of(tmp_path, two_arms(), "#flange=left_tol0")


def test_a_joint_that_follows_another_has_no_column_and_moves_with_it(tmp_path):
    mimic = '<mimic joint="j2" multiplier="-1" offset="0.2"/>'
    joints = [*line(2), joint("level", "l2", "plate", xyz="0.5 0 0", inner=mimic)]
    robot = arm_of(tmp_path, [*joints, joint("j3", "plate", "tool0", xyz="0.2 0 0", axis="0 0 1")])
    free = arm_of(
        tmp_path,
        [*joints[:2], joint("level", "l2", "plate", xyz="0.5 0 0"),
         joint("j3", "plate", "tool0", xyz="0.2 0 0", axis="0 0 1")],
        file="free.urdf",
    )  # fmt: skip
    assert [j.name for j in robot.joints] == ["j1", "j2", "j3"] and free.joint_count == 4
    for q in np.random.default_rng(1).uniform(-2, 2, (8, 3)):
        all_four = np.array([q[0], q[1], 0.2 - q[1], q[2]])
        assert np.allclose(robot.forward(q).matrix, free.forward(all_four).matrix)
        frames = robot.chain.frames(q)
        assert np.allclose(frames.flange_positions[0], free.forward(all_four).position)
        columns = robot.chain.jacobian_columns(frames, frames.flange_positions)[0]
        assert np.allclose(columns, robot.jacobian(q)[:3])


def test_sliding_axes_under_the_arm_and_more_than_eight_joints_work(tmp_path):
    rails = [
        joint("x", "base", "cart", kind="prismatic", axis="1 0 0"),
        joint("y", "cart", "tower", kind="prismatic"),
    ]
    robot = arm_of(tmp_path, [*rails, *line(9, base="tower")])
    assert robot.joint_count == 11 and [j.prismatic for j in robot.joints[:3]] == [True, True, False]
    q = np.zeros(11)
    before = robot.forward(q).position
    q[:2] = 0.3, -0.2
    assert np.allclose(robot.forward(q).position - before, [0.3, -0.2, 0.0])


@pytest.mark.parametrize("name", ["hand", "l2", "tool0"])
def test_a_link_and_a_joint_may_bear_one_name(tmp_path, name):
    joints = [*line(2), fixed(name, "l2", name if name != "l2" else "end", "0.2 0 0")]
    fingers = [jaw(name if name != "l2" else "end", f"f{k}", f"finger_{k}", kind="prismatic") for k in "ab"]
    for behind in ([], fingers):
        robot = arm_of(tmp_path, [*joints, *behind])
        assert robot.joint_count == 2
        assert np.allclose(robot.forward(np.zeros(2)).position, [0.2, 0.0, 0.2])


def test_blocks_of_a_simulator_with_an_undeclared_prefix_are_skipped(tmp_path):
    block = '<gazebo><gazebo:plugin name="x"><a:b/></gazebo:plugin></gazebo><transmission type="t"/>'
    assert arm_of(tmp_path, line(3), extra=block).joint_count == 3


def test_the_address_of_an_arm_is_one_text_that_loads_it_again(tmp_path):
    robot = arm_of(tmp_path, [*line(3), fixed("a", "l3", "odd link, 2nd/a")], "#flange=odd link%2C 2nd/a")
    assert robot.flange == "odd link, 2nd/a"
    assert load_robot(robot.address).flange == robot.flange


def test_the_description_names_its_file_where_a_sign_for_choices_is_part_of_its_name(tmp_path):
    path = tmp_path / "arm#2.urdf"
    path.write_text(description(line(2)))
    assert load_robot(str(path)).joint_count == 2
