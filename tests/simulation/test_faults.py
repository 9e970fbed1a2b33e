from dataclasses import replace

import numpy as np
import pytest

from app.errors import UnknownNameError
from app.geometry import Pose, exp_so3
from app.session.state import robot_named
from app.simulation.faults import Fault, Load, true_flange
from app.simulation.world import default_world
from app.units import from_deg, from_mm

CLOSE_M = from_mm(0.01)
ZERO = Fault("joint_zero", {"joint": 3}, {"offset": from_deg(0.3)})


@pytest.fixture(scope="module")
def robot():
    return robot_named("ur10e")


def test_a_wrong_zero_is_the_arm_at_other_angles(robot):
    q = robot.home + 0.1
    there = true_flange(robot, q, (ZERO,), 1, None)
    assert np.allclose(there.matrix, robot.forward(q + from_deg(0.3) * np.eye(6)[2]).matrix, atol=1e-12)


def test_a_bent_tip_is_bent_from_its_touch_on(robot):
    bent = Fault("tool_slip", {"body": "tool", "from_row": 3}, {"dx": from_mm(2.0)})
    world = replace(default_world(robot), faults=(bent,))
    before, after = (replace(world, row=row).tip(robot.home) for row in (2, 3))
    moved = world.shown_flange(robot.home).rotation.T @ (after.position - before.position)
    assert np.allclose(moved, [from_mm(2.0), 0.0, 0.0], atol=1e-12)
    assert np.allclose(after.rotation, before.rotation)


def test_a_soft_joint_gives_way_under_what_the_arm_carries(robot):
    soft = Fault("joint_compliance", {"joint": 2, "driver": "gravity_torque"}, {"compliance": 1e-5})
    q = robot.home + np.array([0.0, 0.4, 0.0, 0.0, 0.0, 0.0])
    heights = [
        true_flange(robot, q, (soft,), 1, load).position[2] for load in (None, Load(10.0, (0.0, 0.0, 0.2)))
    ]
    assert robot.forward(q).position[2] > heights[0] > heights[1] + from_mm(0.5)


@pytest.mark.parametrize("fault", [ZERO, Fault("joint_compliance", {"joint": 2}, {"compliance": 3e-5})])
def test_a_hand_brings_the_true_tip_to_the_spike_on_a_faulty_arm(robot, fault):
    world = replace(default_world(robot), faults=(fault,), touch_sigma=0.0)
    rng = np.random.default_rng(0)
    for tilt in ((0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.0, -0.5, 0.3)):
        upright = world.tip(robot.home)
        aim = Pose.of(exp_so3(np.array(tilt)) @ upright.rotation, upright.position)
        touched = world.touch(world._go(robot.home, aim).q, rng)
        assert touched.reached and world.distance(touched.q) < CLOSE_M


def test_a_parameter_the_effect_does_not_have_is_refused(robot):
    with pytest.raises(UnknownNameError, match="offset"):
        Fault("joint_zero", {"joint": 3}, {"ofset": 0.1}).checked(robot)
    with pytest.raises(UnknownNameError, match="joint_zero"):
        Fault("joint_zer", {"joint": 3}).checked(robot)
    assert ZERO.checked(robot) is ZERO


def test_the_controller_moves_the_tool_it_reckons_with(robot):
    world = default_world(robot)
    assert world.hand(robot.home) == world.tip(robot.home)
    active = Pose.of(position=np.array([0.0, 0.0, 0.3]))
    other = replace(world, T_flange_tool_active=active)
    assert other.hand(robot.home) == world.shown_flange(robot.home) @ active
    assert other.tip(robot.home) == world.tip(robot.home)
