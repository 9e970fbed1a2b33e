"""Stated uncertainties are honest."""

import numpy as np
import pytest

from app.calibration.quality.region import ellipsoid, half_widths
from app.calibration.solvers.joint import fit_joint
from app.calibration.solvers.pairwise import fit_pairwise
from app.calibration.tool import calibrate
from app.estimation import reach
from app.geometry import angle_between
from app.units import from_deg, from_mm
from tests.calibration.drawing import SPIKE, TOOL, captures, stroke, touches, turns

SIMULATED = 5000
#: What an honest 95% region may be off by, in the share that it covers.
COVERS = (0.93, 0.97)
EXACT = 1e-12


def draw(rng):
    """3 to 7 touches, tilts of 5 to 45 degrees, noise of 0.1 to 0.5 mm."""
    rotations = turns(rng.integers(3, 8), from_deg(rng.uniform(5.0, 45.0)), rng)
    noise = rng.normal(0.0, from_mm(rng.uniform(0.1, 0.5)), (len(rotations), 3))
    return rotations, SPIKE - rotations @ TOOL + noise


@pytest.mark.parametrize("fit", [fit_joint, fit_pairwise])
def test_the_95_percent_region_holds_the_true_tool_point_in_93_to_97_of_100_calibrations(fit):
    rng = np.random.default_rng(11)
    inside = 0
    for _ in range(SIMULATED):
        found = fit(*draw(rng))
        off = found.tool - TOOL
        inside += off @ np.linalg.solve(found.unit_covariance * found.sigma**2, off) <= reach(found.dof) ** 2
    assert COVERS[0] <= inside / SIMULATED <= COVERS[1]


@pytest.mark.parametrize("count", [3, 7])
def test_the_region_is_honest_for_few_and_for_many_touches_alone(count):
    rng = np.random.default_rng(12)
    inside = 0
    for seed in range(2000):
        found = fit_joint(*touches(count, 0.5, rng.uniform(1e-4, 5e-4), seed))
        off = found.tool - TOOL
        inside += off @ np.linalg.solve(found.unit_covariance * found.sigma**2, off) <= reach(found.dof) ** 2
    assert COVERS[0] <= inside / 2000 <= COVERS[1]


def test_each_axis_alone_and_the_drawn_ellipsoid_are_honest_too():
    rng = np.random.default_rng(13)
    alone = whole = 0
    for _ in range(800):
        result = calibrate(captures(*draw(rng)), context={"quiet": True})
        alone += np.sum(np.abs(result.tool_point - TOOL) <= half_widths(result))
        whole += ellipsoid(result).holds(TOOL)
    assert COVERS[0] <= alone / 2400 <= COVERS[1]
    assert COVERS[0] - 0.005 <= whole / 800 <= COVERS[1] + 0.005  # 800 cases: a standard error of 0.008


def test_the_cone_of_a_taught_axis_holds_the_true_axis():
    rng = np.random.default_rng(14)
    inside = 0
    for seed in range(600):
        noise = rng.uniform(1e-4, 5e-4)
        points = captures(*touches(5, 0.5, noise, seed))
        rotation = points[-1].T_base_flange.rotation
        start = captures(rotation[None], (SPIKE - rotation @ TOOL + rng.normal(0, noise, 3))[None], "origin")[
            0
        ]
        ends = [
            stroke(
                start,
                role,
                vector + rng.normal(0, noise, 3) - rotation.T @ (start.T_base_flange.apply(TOOL) - SPIKE),
            )
            for role, vector in (("x", [0.12, 0, 0]), ("z", [0, 0, 0.15]))
        ]
        result = calibrate([*points, start, *ends], orientation="zx", context={"quiet": True})
        x = result.T_flange_tool.rotation[:, 0]
        inside += np.arccos(np.clip(x[0], -1, 1)) <= result.cones[0].half_angle
    assert COVERS[0] <= inside / 600 <= COVERS[1] + 0.01


def test_the_ellipsoid_is_a_right_handed_frame_with_its_longest_axis_first():
    result = calibrate(captures(*touches(4, 0.3, 3e-4)))
    found = ellipsoid(result)
    assert np.linalg.det(found.directions) == pytest.approx(1.0)
    assert (np.diff(found.semi_axes) <= 0).all()
    rebuilt = found.directions @ np.diag(found.semi_axes**2) @ found.directions.T
    np.testing.assert_allclose(rebuilt, result.covariance * reach(result.dof) ** 2, atol=EXACT)


def test_few_degrees_of_freedom_reach_further_than_many():
    assert reach(3) > reach(6) > reach(60) > reach(0)
    assert reach(0) == pytest.approx(2.795, abs=1e-3)  # chi-squared, 3 dimensions
    assert reach(3) == pytest.approx(5.275, abs=1e-3)  # F(3, 3)


def test_the_makers_figure_does_not_see_geometry_and_the_prediction_does():
    mean, predicted = [], []
    for tilt in (5.0, 45.0):
        found = [
            calibrate(captures(*touches(4, from_deg(tilt), 3e-4, s)), context={"quiet": True})
            for s in range(60)
        ]
        mean.append(np.median([r.mean for r in found]))
        predicted.append(np.median([np.sqrt(np.trace(r.covariance)) for r in found]))
    assert mean[0] == pytest.approx(mean[1], rel=0.15)
    assert predicted[0] > 4.0 * predicted[1]


def test_a_frame_turned_by_its_cone_is_a_rotation():
    result = calibrate(captures(*touches(4, 0.3)))
    assert angle_between(result.T_flange_tool.rotation, np.eye(3)) == pytest.approx(0.0)
