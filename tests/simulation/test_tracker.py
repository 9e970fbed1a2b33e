"""The tracker sees what it would see, and the whole procedure ends near the hidden truth."""

import numpy as np
import pytest

from app.geometry import Pose
from app.kinematics import load_robot
from app.simulation.tracker import Capsule, LaserTracker, segment_distance
from app.simulation.tracker_cell import make_cell, zero_position
from app.simulation.tracker_procedure import carry_out

NOISE_AGREES = 0.05  # relative, of 4,000 draws
EXACT = 1e-9
SIGMAS = 4.0
PUSH = Pose.exp(np.array([0.02, 0.01, 0.0, 0.0, 0.0, 0.01]))


def _tracker(**options):
    return LaserTracker(Pose.identity(), **options)


def test_noise_grows_with_distance_as_makers_state_it():
    tracker, rng = _tracker(), np.random.default_rng(0)
    for distance in (2.0, 20.0):
        p = np.array([distance, 0.0, 0.0])
        draws = np.array([tracker.look(p, None, (), rng).point for _ in range(4000)]) - p
        assert draws.std() == pytest.approx(15e-6 + 6e-6 * distance, rel=NOISE_AGREES)


@pytest.mark.parametrize(
    ("place", "reason"),
    [((0.1, 0, 0), "range"), ((50, 0, 0), "range"), ((0.2, 0, 3), "elevation"), ((1, 0, -3), "elevation")],
)
def test_what_lies_beyond_the_instruments_limits_is_not_seen(place, reason):
    sight = _tracker().look(np.array(place, float), None, (), None)
    assert not sight.seen and sight.reason == reason


def test_a_reflector_that_looks_away_is_not_seen():
    p, tracker = np.array([3.0, 0, 0]), _tracker(acceptance=np.radians(30))
    assert tracker.look(p, np.array([-1.0, 0, 0]), (), None).seen
    aside = np.array([-np.cos(0.6), np.sin(0.6), 0])
    assert tracker.look(p, aside, (), None).reason == "turned_away"


def test_an_arm_in_the_beam_breaks_it_and_is_named():
    p = np.array([4.0, 0, 0])
    rod = Capsule(np.array([2.0, 0.05, -1]), np.array([2.0, 0.05, 1]), 0.1, "robot 2")
    sight = _tracker().look(p, None, (rod,), None)
    assert sight.reason == "occluded" and "robot 2" in sight.sentence
    beside = Capsule(np.array([2.0, 0.15, -1]), np.array([2.0, 0.15, 1]), 0.1)
    behind = Capsule(np.array([4.2, 0, -1]), np.array([4.2, 0, 1]), 0.1)
    assert _tracker().look(p, None, (beside, behind), None).seen


def test_segment_distance_is_the_least_over_both_segments():
    rng = np.random.default_rng(1)
    s = np.linspace(0, 1, 101)
    for _ in range(20):
        a, b, c, d = rng.normal(size=(4, 3))
        grid = (a + s[:, None] * (b - a))[:, None] - (c + s[:, None] * (d - c))[None]
        least = np.linalg.norm(grid, axis=-1).min()
        found = segment_distance(a, b, c, d)
        assert found <= least + EXACT and least - found < 0.03


@pytest.fixture(scope="module")
def cell():
    return make_cell("ur10e", "irb120", 3)


def test_any_two_robots_stand_in_a_zero_position_that_draws_a_circle(cell):
    for arm in cell.arms:
        p = arm.robot.forward(zero_position(arm.robot)).position
        assert np.hypot(p[0], p[1]) > 0.25 * arm.robot.reach and arm.rest[0] == 0.0


def test_the_wizard_runs_headless_to_a_miss_as_small_as_predicted(cell):
    out = carry_out(cell, 1)
    assert out.wizard.done and out.relation.T_base1_base2 is not None
    assert out.miss < SIGMAS * out.relation.sigma_meeting
    assert out.relation.sigma_meeting < 1e-3


def test_over_many_runs_the_true_relation_lies_in_the_95_percent_region(cell):
    inside, runs = 0, 24
    for seed in range(runs):
        out = carry_out(cell, seed, nests=False, every=np.radians(15))
        gap = out.relation.T_base1_base2.inverse() @ cell.T_base1_base2
        error = np.concatenate([gap.position, gap.rotvec])
        inside += error @ np.linalg.solve(out.relation.covariance, error) < 12.5916  # chi-squared, 6, 95%
    assert inside >= 20  # of 24: fewer come in 1 of 170 sets where 95% is true


def test_a_pushed_tracker_is_seen_by_the_nests_and_taken_out(cell):
    out = carry_out(cell, 2, pushed=PUSH)
    assert [w.code for w in out.relation.warnings] == ["tracker_moved"]
    assert out.miss < SIGMAS * out.relation.sigma_meeting


def test_a_pushed_tracker_without_nests_spoils_the_relation_unseen(cell):
    out = carry_out(cell, 2, pushed=PUSH, nests=False)
    assert out.miss > 0.01 and not out.relation.warnings and out.relation.notes


def test_the_makers_frame_of_each_arm_is_found_as_well(cell):
    out = carry_out(cell, 3)
    for base, arm in zip(out.bases, cell.arms, strict=True):
        true = cell.tracker.T_world_tracker.inverse() @ arm.T_world_base
        gap = base.maker.T_tracker_maker.inverse() @ true
        assert np.linalg.norm(gap.position) < 1e-3 and np.linalg.norm(gap.rotvec) < 1e-3


def test_upright_arms_bend_before_the_procedure():
    q = zero_position(load_robot("iiwa14"))
    assert np.abs(q[1:]).max() > 0.1
