"""The estimators of the tool point."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.calibration.solvers.joint import fit_joint, solve_joint
from app.calibration.solvers.pairwise import fit_pairwise
from app.calibration.solvers.robust import fit_robust
from app.calibration.tool import calibrate
from app.errors import DegenerateGeometryError, TooFewPointsError
from app.geometry import Pose, exp_so3, rot_x, rot_z
from tests.calibration.drawing import SPIKE, TOOL, captures, touches

EXACT = 1e-9  # m, of a metre
NOISE = 3e-4
FITS = [fit_joint, fit_pairwise, fit_robust]


@pytest.mark.parametrize("fit", FITS)
@settings(max_examples=60, deadline=None)
@given(st.integers(3, 12), st.floats(0.05, 1.2), st.integers(0, 10**6))
def test_touches_without_noise_give_tool_and_spike_back(fit, count, tilt, seed):
    found = fit(*touches(count, tilt, 0.0, seed))
    np.testing.assert_allclose(found.tool, TOOL, atol=EXACT)
    np.testing.assert_allclose(found.touched, SPIKE, atol=EXACT)


def test_the_closed_form_is_the_least_squares_solution():
    rotations, positions = touches(6, 0.5, NOISE, 3)
    matrix = np.concatenate([rotations, -np.broadcast_to(np.eye(3), (6, 3, 3))], axis=2).reshape(-1, 6)
    reference = np.linalg.lstsq(matrix, -positions.reshape(-1), rcond=None)[0]
    np.testing.assert_allclose(np.r_[solve_joint(rotations, positions)], reference, atol=EXACT)


def test_many_problems_at_once_give_what_each_gives_alone():
    problems = [touches(7, 0.4, NOISE, seed) for seed in range(50)]
    rotations, positions = (np.array(part) for part in zip(*problems, strict=True))
    tools, spikes = solve_joint(rotations, positions)
    for i, problem in enumerate(problems):
        tool, spike = solve_joint(*problem)
        np.testing.assert_allclose(tools[i], tool, atol=EXACT)
        np.testing.assert_allclose(spikes[i], spike, atol=EXACT)


@settings(max_examples=40, deadline=None)
@given(st.permutations(range(5)))
def test_the_joint_fit_does_not_depend_on_the_order(order):
    rotations, positions = touches(5, 0.5, NOISE, 1)
    np.testing.assert_allclose(
        fit_joint(rotations[order], positions[order]).tool, fit_joint(rotations, positions).tool, atol=EXACT
    )


@pytest.mark.parametrize("fit", FITS)
def test_the_tool_point_does_not_depend_on_where_the_base_stands(fit):
    rotations, positions = touches(5, 0.5, NOISE, 1)
    moved = Pose.of(exp_so3(np.array([0.4, -1.0, 2.0])), np.array([3.0, -2.0, 1.0]))
    np.testing.assert_allclose(
        fit(moved.rotation @ rotations, moved.apply(positions)).tool,
        fit(rotations, positions).tool,
        atol=EXACT,
    )


@pytest.mark.parametrize("fit", FITS)
@pytest.mark.parametrize("count", [0, 1, 2])
def test_fewer_than_three_touches_are_refused(fit, count):
    rotations, positions = touches(5, 0.5)
    with pytest.raises(TooFewPointsError) as caught:
        fit(rotations[:count], positions[:count])
    assert caught.value.code == "too_few"


@pytest.mark.parametrize("fit", FITS)
@pytest.mark.parametrize("count", [3, 7])
def test_touches_about_one_axis_raise_degenerate_geometry(fit, count):
    rotations = rot_x(0.3) @ rot_z(np.linspace(0.0, 2.0, count))
    with pytest.raises(DegenerateGeometryError) as caught:
        fit(*touches(rotations=rotations))
    assert caught.value.code == "one_axis" and caught.value.rank == 2
    assert caught.value.unseen == "(0.00, 0.00, 1.00)"


def test_touches_without_any_turn_are_told_apart_from_those_about_one_axis():
    with pytest.raises(DegenerateGeometryError, match="same orientation"):
        fit_joint(*touches(rotations=np.tile(np.eye(3), (4, 1, 1))))


@pytest.mark.parametrize("fit", [fit_joint, fit_pairwise])
def test_the_gains_say_how_the_tool_point_follows_an_error_of_a_tip(fit):
    rotations, positions = touches(5, 0.5, NOISE, 2)
    found, push = fit(rotations, positions), np.array([1e-4, -2e-4, 3e-4])
    for i in range(5):
        moved = positions.copy()
        moved[i] += push
        np.testing.assert_allclose(fit(rotations, moved).tool - found.tool, found.gains[i] @ push, atol=EXACT)


@pytest.mark.parametrize("fit", [fit_joint, fit_pairwise])
def test_the_predicted_covariance_is_that_of_many_repeats(fit):
    rotations, _ = touches(5, 0.5, 0.0, 4)
    rng = np.random.default_rng(0)
    exact = SPIKE - rotations @ TOOL
    tools = [fit(rotations, exact + rng.normal(0.0, NOISE, (5, 3))).tool for _ in range(3000)]
    predicted = fit(rotations, exact).unit_covariance * NOISE**2
    spread = np.cov(np.array(tools).T)
    assert np.abs(spread - predicted).max() < 0.1 * np.abs(predicted).max()


def test_the_robust_fit_keeps_every_touch_and_says_what_it_counted():
    rotations, positions = touches(9, 0.6, 1e-4, 5)
    positions[4] += np.array([0.004, 0.0, 0.0])
    robust, plain = fit_robust(rotations, positions), fit_joint(rotations, positions)
    assert len(robust.weights) == 9 and (robust.weights > 0).all()
    assert np.argmin(robust.weights) == 4 and robust.weights[4] < 0.2
    assert np.linalg.norm(robust.tool - TOOL) < 0.3 * np.linalg.norm(plain.tool - TOOL)


#: One touch of four is off by this [m], fifteen times the noise: what three others exclude.
OFF = np.array([0.0045, 0.0, 0.0])


def test_of_four_touches_the_one_that_the_others_exclude_counts_less():
    told = 0
    for seed in range(40):
        rotations, positions = touches(4, 0.6, NOISE, seed)
        positions[seed % 4] += OFF
        found = fit_robust(rotations, positions)
        told += bool(np.argmin(found.weights) == seed % 4 and found.weights[seed % 4] < 0.5)
    assert told > 30


def test_four_touches_with_noise_alone_all_count():
    least = [fit_robust(*touches(4, 0.6, NOISE, seed)).weights.min() for seed in range(200)]
    assert np.mean(np.array(least) < 0.5) < 0.1


def test_four_touches_that_cannot_tell_say_so():
    said = {"told": 0, "undecided": 0, "silent": 0}
    for seed in range(40):
        rotations, positions = touches(4, 0.6, 3e-3, seed)
        result = calibrate(captures(rotations, positions), method="robust")
        codes = {w.code for w in result.warnings}
        if result.weights.min() < 0.5:
            said["told"] += 1
        elif "robust_undecided" in codes:
            said["undecided"] += 1
        else:
            said["silent"] += 1
            assert result.mean <= 5e-4
    assert said["undecided"] > 20


def test_three_touches_cannot_tell_and_say_so():
    rotations, positions = touches(3, 0.6, 4e-3, 1)
    result = calibrate(captures(rotations, positions), method="robust")
    assert "robust_undecided" in {w.code for w in result.warnings}
