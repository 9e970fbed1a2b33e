"""How long a way takes, by a clock of the test's own."""

import numpy as np
import pytest

from app.kinematics import load_robot, robot_names
from app.session.motion.pace import TIP_SPEED, TURN_SPEED, Pace, duration, tool_points, travel
from app.simulation.world import default_tool

TICK_S = 1.0 / 30.0
ROUNDING = 1.02  # a tick more than the way takes


class Slow:
    """A drive of the test's own."""

    def __init__(self, override=1.0):
        self.override, self.live, self.now = override, True, 0.0

    def clock(self):
        return self.now


def gone(drive, steps):
    """Ticks until a way has ended: seconds it took."""
    begun = drive.now
    for _ in steps:
        drive.now += TICK_S
    return drive.now - begun


def way(robot, seed=0):
    rng = np.random.default_rng(seed)
    low, high = np.maximum(robot.lower, -1.5), np.minimum(robot.upper, 1.5)
    return robot.home, rng.uniform(low, high)


@pytest.mark.parametrize("name", robot_names())
def test_no_point_of_the_tool_and_no_joint_exceeds_its_speed_on_any_way(name):
    robot = load_robot(name)
    points = tool_points(default_tool(robot), default_tool(robot))
    start, end = way(robot)
    seconds = duration(robot, start, end, points)
    shares = np.linspace(0.0, 1.0, 400)
    poses = [robot.forward(start + (end - start) * share) for share in shares]
    tips = np.array([[pose.apply(p) for p in points] for pose in poses])
    speeds = np.linalg.norm(np.diff(tips, axis=0), axis=2) / (seconds / (len(shares) - 1))
    assert speeds.max() <= TIP_SPEED * ROUNDING
    turned = np.abs(end - start)[~robot.chain.prismatic]
    assert (turned / seconds).max(initial=0.0) <= TURN_SPEED * 1.0001


@pytest.mark.parametrize("override", [1.0, 0.5, 0.05])
def test_a_way_home_takes_the_time_that_the_override_means(override):
    robot = load_robot("ur10e")
    start, end = way(robot)
    points = tool_points(default_tool(robot), default_tool(robot))
    seconds, drive, shown = duration(robot, start, end, points), Slow(override), []
    took = gone(drive, travel(drive, start, end, seconds, shown.append))
    assert took == pytest.approx(seconds / override, abs=3 * TICK_S)
    assert np.array_equal(shown[-1], end)


def test_while_the_switch_is_not_held_no_time_passes():
    drive, shown = Slow(), []
    steps = travel(drive, np.zeros(1), np.ones(1), 1.0, lambda q: shown.append(float(q[0])))
    for _ in range(10):
        drive.now += TICK_S
        next(steps)
    at = shown[-1]
    drive.live = False
    for _ in range(100):
        drive.now += TICK_S
        next(steps)
    assert shown[-1] == at
    drive.live = True
    assert gone(drive, steps) == pytest.approx(1.0 - at, abs=3 * TICK_S)


def test_a_machine_that_stutters_does_not_leap():
    drive = Slow()
    pace = Pace(drive)
    drive.now += 5.0
    assert pace.passed() <= 0.1
