"""Every robot folder: what it must hold, and what of it can be checked against the maker's own figures."""

import numpy as np
import pytest

from app.geometry import Pose
from app.kinematics import load_robot, robot_names
from app.kinematics.shapes import read_shapes

REACH_TOLERANCE = 0.005  # of the maker's figure, which is rounded to millimetres or centimetres
ROUNDING = 1e-9  # kg m^2
SHIPPED = {"jby50", "ur5", "ur10e", "panda", "iiwa7", "iiwa14", "irb120", "r2000ic_165f"}

#: Sum of the masses that move [kg], added up by hand from the sources named in SOURCE.md.
MOVING_MASS = {
    "jby50": 400.0,
    "ur5": 17.0489,
    "ur10e": 29.104,
    "panda": 16.062138,
    "iiwa7": 17.5,
    "iiwa14": 17.5,
    "irb120": 11.931,
    "r2000ic_165f": 0.0,
}


@pytest.fixture(params=robot_names())
def robot(request):
    return load_robot(request.param)


def test_the_robots_that_were_promised_are_there():
    assert set(robot_names()) >= SHIPPED


def test_its_folder_says_what_it_is_and_where_its_figures_come_from(robot):
    info = robot.description
    assert {"title", "maker", "reach_m", "payload_kg", "source", "home_rad"} <= set(info)
    source = robot.path.with_name("SOURCE.md").read_text(encoding="utf-8")
    assert all(word in source for word in ("payload", "reach", "limits", "masses", "drawing"))


def test_limits_are_ordered_speeds_positive_and_home_is_inside(robot):
    assert np.all(robot.lower < robot.upper)
    assert np.all(robot.velocity > 0)
    assert len(robot.home) == robot.joint_count
    assert robot.within_limits(robot.home, margin=0.01)


def farthest(robot, start, end):
    """Largest distance [m] of joint `end` (or the flange, one past the last) from joint `start`, within limits.

    From joint 1 it is measured level, from its axis; from another it is measured straight.
    """
    rng = np.random.default_rng(0)
    low, high = np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)

    def distance(q):
        frames = robot.chain.frames(q)
        p = frames.flange_positions if end > robot.joint_count else frames.joint_positions[:, end - 1]
        away = p - frames.joint_positions[:, start - 1]
        return np.linalg.norm(away[:, :2] if start == 1 else away, axis=1)

    samples = rng.uniform(low, high, (4000, robot.joint_count))
    values, best = distance(samples), 0.0
    for q in samples[np.argsort(values)[-4:]]:
        step, value = 0.3, float(distance(q[None])[0])
        while step > 1e-4:
            trials = np.clip(q + rng.normal(0, step, (64, len(q))), low, high)
            found = distance(trials)
            if found.max() > value:
                q, value = trials[np.argmax(found)], float(found.max())
            else:
                step *= 0.5
        best = max(best, value)
    return best


def test_the_published_reach_is_what_its_lengths_and_limits_give(robot):
    info = robot.description
    ends = info["reach_to_joint"]
    if isinstance(ends, list):  # a working radius that the maker rounds: between these two points
        near, far = (farthest(robot, info["reach_from_joint"], end) for end in ends)
        assert near < info["reach_m"] < far
    else:
        assert farthest(robot, info["reach_from_joint"], ends) == pytest.approx(
            info["reach_m"], rel=REACH_TOLERANCE
        )


def test_masses_are_the_published_ones_and_inertias_are_those_of_real_bodies(robot):
    chain = robot.chain
    assert chain.masses.sum() == pytest.approx(MOVING_MASS.get(robot.name, chain.masses.sum()), abs=2e-4)
    if not robot.has_inertials:
        return
    assert np.all(chain.masses > 0)
    for inertia in chain.inertias:
        moments = np.linalg.eigvalsh(inertia)
        assert np.abs(inertia - inertia.T).max() < ROUNDING
        assert moments[0] > 0
        assert moments[0] + moments[1] >= moments[2] * (1 - 1e-3)  # figures with four decimals


def test_centres_of_mass_lie_within_the_drawing(robot):
    if not robot.has_inertials:
        return
    shapes = read_shapes(robot.path, tuple(j.name for j in robot.joints))
    for body in range(1, robot.joint_count + 1):
        places = np.array([s.T_body_shape.position for s in shapes if s.body == body])
        sizes = np.array([max(s.size) for s in shapes if s.body == body])[:, None]
        low, high = (places - sizes).min(axis=0), (places + sizes).max(axis=0)
        com = robot.chain.coms[body - 1]
        assert np.all(com > low - 0.05) and np.all(com < high + 0.05), (body, com)


def test_every_moving_body_is_drawn_in_colours_of_its_own(robot):
    shapes = read_shapes(robot.path, tuple(j.name for j in robot.joints))
    assert {s.body for s in shapes} == set(range(robot.joint_count + 1))
    assert len({s.colour for s in shapes}) >= 3
    assert all(min(s.size) > 0 for s in shapes if s.kind != "cylinder")


def test_the_drawing_reaches_the_flange(robot):
    from app.kinematics.solids import robot_solids

    last = [s for s in robot_solids(robot) if s.body == robot.joint_count]
    flange = Pose.of(robot.chain.flange_rotation, robot.chain.flange_translation).inverse()
    heights = np.concatenate([flange.apply(s.points)[:, 2] for s in last])
    assert heights.max() == pytest.approx(0.0, abs=1e-3)  # the flange plane is where the drawing ends
