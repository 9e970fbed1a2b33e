import pytest

from app.kinematics import load_robot
from app.kinematics.singular import singular_joints


@pytest.mark.parametrize("name", ["ur10e", "jby50", "irb120", "r2000ic_165f"])
def test_a_straight_wrist_is_axes_4_and_6(name):
    robot = load_robot(name)
    q = robot.home.copy()
    q[4] = 0.0
    axes = robot.chain.frames(q[None]).axes[0]
    assert abs(axes[3] @ axes[5]) == pytest.approx(1.0)
    assert {4, 6} <= set(singular_joints(robot, q))
    if name != "ur10e":  # a spherical wrist: nobody else takes part
        assert singular_joints(robot, q) == (4, 6)


def test_a_stretched_arm_is_about_the_joints_that_stretch_it():
    robot = load_robot("ur10e")
    q = robot.home.copy()
    q[2] = 0.0  # elbow straight
    joints = set(singular_joints(robot, q))
    assert {2, 3} <= joints and 1 not in joints
