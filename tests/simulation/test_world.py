import numpy as np
import pytest

from app.kinematics import robot_names
from app.session.state import robot_named
from app.simulation.world import default_world

NOISE_TOLERANCE = 0.15  # relative, of a standard deviation from 300 draws


@pytest.mark.parametrize("name", robot_names())
def test_every_shipped_arm_can_touch_its_spike(name):
    robot = robot_named(name)
    world = default_world(robot)
    touched = world.touch(robot.home, np.random.default_rng(0))
    assert touched.reached and world.touching(touched.q)


def test_a_touch_misses_by_the_stated_noise():
    robot = robot_named("ur10e")
    world = default_world(robot)
    rng = np.random.default_rng(1)
    q = world.touch(robot.home, rng).q
    tips = np.array([world.tip(world.touch(q, rng).q).position - world.p_base_spike for _ in range(100)])
    assert np.abs(tips.std() / world.touch_sigma - 1.0) < NOISE_TOLERANCE


def test_a_stroke_moves_along_the_true_axis_without_turning():
    robot = robot_named("ur10e")
    world = default_world(robot)
    rng = np.random.default_rng(2)
    q = world.touch(robot.home, rng).q
    start, end = world.tip(q), world.tip(world.stroke(q, 0, 0.1, rng).q)
    assert np.allclose(end.rotation, start.rotation, atol=1e-5)
    assert np.allclose(end.position - start.position, 0.1 * start.rotation[:, 0], atol=6 * world.touch_sigma)


def test_the_same_seed_touches_the_same():
    robot = robot_named("ur10e")
    world = default_world(robot)
    a, b = (world.touch(robot.home, np.random.default_rng(7)).q for _ in range(2))
    assert np.array_equal(a, b)
