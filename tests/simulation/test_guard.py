"""The guard: ways end before anything is hit, contact is felt, and away is always free."""

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import Contact, load_robot, robot_names, solve_ik
from app.session.motion.guarding import guard_of
from app.simulation.guard import MARGIN, Stop
from app.simulation.route import route
from app.simulation.world import default_world
from app.units import from_mm

#: From the orientation at home [rad]: how the torch stands on the spike.
TILTS = (
    (0.0, 0.0, 0.0),
    (0.5, 0.0, 0.0),
    (-0.5, 0.0, 0.0),
    (0.0, 0.5, 0.0),
    (0.0, -0.5, 0.0),
    (0.0, 0.0, 1.0),
)


def placed(world, rotation, point, q):
    found = solve_ik(
        world.robot, Pose.of(rotation, point), q, T_flange_tool=world.T_flange_tool_true, max_steps=200
    )
    return found.q if found.reached else None


def touches(world):
    rng = np.random.default_rng(3)
    home = world.robot.home
    upright = world.tip(home).rotation
    aims = [
        (exp_so3(np.array(tilt)) @ upright, world.p_base_spike + rng.normal(0, world.touch_sigma, 3))
        for tilt in TILTS
    ]
    return [q for q in (placed(world, rotation, point, home) for rotation, point in aims) if q is not None]


def advanced(guard, q, ends):
    """Through short pieces, as a jog goes: where it ended, and what stopped it."""
    for end in ends:
        q, stop = guard.advance(q, end)
        if stop is not None:
            return q, stop
    return q, None


def line(world, q, step, count):
    """Joint poses whose tip goes along a straight line from that of q (n,)."""
    start = world.tip(q)
    ways = []
    for k in range(1, count + 1):
        q = placed(world, start.rotation, start.position + k * np.asarray(step), q)
        ways.append(q)
    return ways


@pytest.mark.parametrize("name", robot_names())
def test_every_arm_gets_from_touch_to_touch_without_hitting_anything(name):
    world = default_world(load_robot(name))
    guard = guard_of(world)
    at = world.robot.home
    poses = touches(world)
    assert len(poses) >= 4
    for q in poses:
        way = route(world, guard, at, q)
        assert isinstance(way, list) and np.array_equal(way[-1], q), way
        for a, b in zip([at, *way], way, strict=False):
            for share in np.linspace(0.0, 1.0, 60):
                assert not guard_of(world)._bodies.touching(a + (b - a) * share)
        at = q


def test_a_way_ends_before_the_table_and_may_be_gone_back():
    world = default_world(load_robot("jby50"))
    guard = guard_of(world)
    beside = world.p_base_spike + np.array([0.0, 0.2, 0.0])
    q = placed(world, world.tip(world.robot.home).rotation, beside, world.robot.home)
    down = line(world, q, (0.0, 0.0, from_mm(-8.0)), 40)
    at, stop = advanced(guard, q, down)
    assert stop is not None and stop.kind == "hit" and "table" in (stop.a, stop.b)
    height = world.tip(at).position[2] - world.table_height
    assert 0.0 < height < from_mm(50.0)
    assert min(guard._bodies.touching(at).values(), default=MARGIN) > MARGIN / 2
    again, stop = guard.advance(at, at + 0.05 * (down[-1] - q))
    assert stop is not None and np.abs(again - at).max() < 1e-3
    back, stop = guard.advance(at, q)
    assert stop is None and np.array_equal(back, q)


@pytest.mark.parametrize("beside_mm", [0.0, 0.4, -0.7])
def test_a_tip_that_comes_down_on_the_spike_stops_where_it_is_nearest(beside_mm):
    world = default_world(load_robot("jby50"))
    guard = guard_of(world)
    beside = np.array([from_mm(beside_mm), 0.0, 0.0])
    rotation = world.tip(world.robot.home).rotation
    start = placed(world, rotation, world.p_base_spike + beside + [0.0, 0.0, 0.03], world.robot.home)
    down = line(world, start, (0.0, 0.0, from_mm(-3.0)), 15)
    at, stop = advanced(guard, start, down)
    assert stop is not None and stop.kind in ("touch", "press")
    assert abs(beside_mm) - 0.05 <= world.distance(at) * 1e3 <= abs(beside_mm) + 0.5
    on, stop = advanced(guard, at, line(world, at, (0.0, 0.0, from_mm(-1.0)), 5))
    assert stop is not None and np.allclose(on, at)
    _, stop = advanced(guard, at, line(world, at, (0.0, 0.0, from_mm(3.0)), 5))
    assert stop is None


def test_the_side_of_the_spike_is_solid():
    world = default_world(load_robot("jby50"))
    guard = guard_of(world)
    rotation = world.tip(world.robot.home).rotation
    low = world.p_base_spike - [0.0, 0.0, from_mm(15.0)]
    start = placed(world, rotation, low + np.array([from_mm(-40.0), 0.0, 0.0]), world.robot.home)
    at, stop = advanced(guard, start, line(world, start, (from_mm(2.0), 0.0, 0.0), 40))
    assert stop is not None and world.tip(at).position[0] < low[0]


def test_where_no_way_is_free_the_pair_in_the_straight_way_is_named():
    world = default_world(load_robot("ur10e"))
    q = world.robot.home.copy()
    q[1] = 0.6  # the upper arm through the table
    found = route(world, guard_of(world), world.robot.home, q)
    assert isinstance(found, Stop) and found.kind == "hit"


def test_an_arm_that_stands_in_something_can_leave_it():
    world = default_world(load_robot("jby50"))
    guard = guard_of(world)
    rotation, beside = world.tip(world.robot.home).rotation, world.p_base_spike + np.array([0.0, 0.2, 0.0])
    inside = np.array([*beside[:2], world.table_height - from_mm(25.0)])
    above = placed(world, rotation, beside, world.robot.home)
    q = placed(world, rotation, inside, above)
    assert min(guard._bodies.touching(q).values()) < -MARGIN
    back, stop = guard.advance(q, above)
    assert stop is None and np.array_equal(back, above)


def test_the_fence_is_hit_and_named():
    world = default_world(load_robot("ur10e"))
    guard = guard_of(world)
    q = world.robot.home.copy()
    q[1], q[2] = -0.35, 0.1  # stretched
    q[0] += np.pi / 2
    start = q.copy()
    start[1], start[2] = world.robot.home[1:3]
    _, stop = guard.advance(start, q)
    assert stop is not None and "fence" in (stop.a, stop.b), stop


def test_a_way_that_leaves_the_spike_is_looked_at_seldom_where_nothing_can_be_felt(monkeypatch):
    """Proposals walk hundreds of such ways: looked at every 0.4 mm they took a third of a class's processor."""
    world = default_world(load_robot("ur10e"))
    guard, looks, distance = guard_of(world), [], Contact.distance
    monkeypatch.setattr(Contact, "distance", lambda self, pose: looks.append(1) or distance(self, pose))
    q = touches(world)[0]
    away = line(world, q, -from_mm(5.0) * world.tip(q).rotation[:, 2], 30)[-1]
    assert guard.free(q, away) is None
    assert 0 < len(looks) < 100
