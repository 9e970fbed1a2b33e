"""A payload is found by moving the arm: the log knows the load, the search knows the log alone."""

import numpy as np
import pytest

from app.kinematics import load_robot, robot_names
from app.kinematics.dynamics import inverse_dynamics
from app.session.motion.guarding import guard_of, hit
from app.simulation.route import route
from app.simulation.world import default_world
from app.training.weighing import APART, hidden_load, least_turn, off, proposed, run_through, weigh, write_log
from app.units import from_mm

MASS_SHARE, CENTRE_M = 0.02, from_mm(3.0)
SURE_SHARE, SURE_M = 0.06, from_mm(12.0)  # half a 95% interval, at most
ARMS = [name for name in robot_names() if load_robot(name).has_inertials]


@pytest.mark.parametrize("name", ["ur10e", "jby50", "irb120"])
def test_the_load_that_hangs_there_is_found_with_honest_doubt(name, tmp_path):
    robot, said = load_robot(name), []
    found = weigh(name, proposed(robot), 4, tmp_path, lambda share, doing: said.append(share))
    true = hidden_load(robot, 4)
    mass, centre = off(found, true)
    assert mass < MASS_SHARE and centre < CENTRE_M
    assert 0.0 < found.mass_half < SURE_SHARE * true.mass
    assert min(found.centre_half) > 0.0 and max(found.centre_half) < SURE_M
    assert said and max(said) <= 1.0


def test_no_file_of_the_lesson_says_what_hangs_there(tmp_path):
    robot = load_robot("ur10e")
    path = write_log(robot, proposed(robot), 4, tmp_path)
    text, true = path.read_text(encoding="utf-8"), hidden_load(robot, 4)
    assert "payload" not in text and f"{true.mass:.4f}" not in text.splitlines()[1]
    assert hidden_load(robot, 5) != true


@pytest.mark.parametrize("name", ARMS)
def test_the_proposed_poses_differ_enough_and_lie_within_the_arms_limits(name):
    robot = load_robot(name)
    poses = proposed(robot)
    assert least_turn(robot, poses) > APART
    assert robot.within_limits(poses).all()
    world = default_world(robot)
    guard = guard_of(world)
    for here, there in zip(poses, np.roll(poses, -1, axis=0), strict=True):
        assert hit(world, here) is None
        assert isinstance(route(world, guard, here, there), list)


def test_the_run_is_smooth_and_stands_at_every_pose():
    robot = load_robot("ur10e")
    poses = proposed(robot)
    t, q, qd, qdd = run_through(poses)
    step = t[1] - t[0]
    assert np.abs(np.gradient(q, step, axis=0) - qd).max() < 0.01
    assert np.abs(np.gradient(qd, step, axis=0) - qdd).max() < 0.1
    for pose in poses:
        assert (np.abs(q - pose).max(axis=1) < 1e-12).sum() >= 100


def test_a_standing_arm_feels_the_weight_it_should(tmp_path):
    """Written another way: gravity on the mass, and its lever about the last but one axis."""
    robot = load_robot("ur10e")
    poses = proposed(robot)
    rows = np.loadtxt(write_log(robot, poses, 4, tmp_path), delimiter=",", skiprows=4)
    q, torque = rows[10:60, 1:7], rows[10:60, 13:19].mean(axis=0)
    bare = inverse_dynamics(robot, q[:1], 0 * q[:1], 0 * q[:1])[0]
    true = hidden_load(robot, 4)
    place = robot.forward(q[0]).apply(np.array(true.centre))
    frames = robot.chain.frames(q[:1])
    weight = np.array([0.0, 0.0, true.mass * 9.81])
    for joint in range(6):
        lever = np.cross(frames.axes[0, joint], place - frames.joint_positions[0, joint])
        assert torque[joint] - bare[joint] == pytest.approx(lever @ weight, abs=0.3)
