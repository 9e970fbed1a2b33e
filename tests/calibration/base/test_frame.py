"""Two axes -> base frame: 1,000 random cells."""

import numpy as np
import pytest
from scipy.stats import chi2

from app.calibration.base.batch import solve_cells
from app.calibration.base.frame import Axes, base_frames, point_jacobian
from app.geometry import Pose, exp_so3, log_so3
from tests.calibration.base.cells import random_cells

CELLS = 1000
COVERED = (0.93, 0.97)
ANALYTIC = 1e-5  # relative, against central differences


@pytest.fixture(scope="module")
def thousand():
    cells = random_cells(20, CELLS, square=np.radians(0.05))
    found = solve_cells(cells.first, cells.second, cells.sigma_first, cells.sigma_second)
    return cells, found


def _errors(cells, found):
    rotation = found.matrices[:, :3, :3]
    moved = np.einsum("mji,mj->mi", rotation, cells.truth[:, :3, 3] - found.matrices[:, :3, 3])
    turned = log_so3(np.swapaxes(rotation, -1, -2) @ cells.truth[:, :3, :3])
    return np.concatenate([moved, turned], axis=1)


def test_the_95_percent_region_holds_the_true_base_in_95_percent_of_cells(thousand):
    cells, found = thousand
    error = _errors(cells, found)
    distance = np.einsum("mi,mij,mj->m", error, np.linalg.inv(found.covariance), error)
    inside = np.mean(distance < chi2.ppf(0.95, 6))
    assert COVERED[0] < inside < COVERED[1]


def test_every_single_uncertainty_holds_95_percent_too(thousand):
    cells, found = thousand
    scaled = _errors(cells, found) / np.sqrt(np.diagonal(found.covariance, axis1=1, axis2=2))
    inside = np.mean(np.abs(scaled) < 1.959964, axis=0)
    assert (inside > COVERED[0] - 0.005).all() and (inside < COVERED[1] + 0.005).all(), inside


def test_the_sign_of_every_axis_is_right_in_every_cell(thousand):
    cells, found = thousand
    agree = np.einsum("mij,mij->mj", found.matrices[:, :3, :3], cells.truth[:, :3, :3])
    assert (agree > 0.999).all()
    assert (np.linalg.det(found.matrices[:, :3, :3]) > 0.999).all()
    assert (found.axis2_along_y > 0.99).all()


def test_the_region_at_the_place_of_work_holds_95_percent(thousand):
    cells, found = thousand
    at = np.array([1.2, 0.3, 0.4])
    j = point_jacobian(at)
    covariance = j @ found.covariance @ j.T
    miss = np.einsum(
        "mij,mj->mi", np.linalg.inv(found.matrices) @ cells.truth, np.tile([*at, 1.0], (CELLS, 1))
    )
    miss = miss[:, :3] - at
    distance = np.einsum("mi,mij,mj->m", miss, np.linalg.inv(covariance), miss)
    assert COVERED[0] < np.mean(distance < chi2.ppf(0.95, 3)) < COVERED[1]


def test_axes_that_meet_give_a_frame_as_good_as_others():
    cells = random_cells(21, 200, meeting=1.0)
    found = solve_cells(cells.first, cells.second, cells.sigma_first, cells.sigma_second)
    error = _errors(cells, found)
    distance = np.einsum("mi,mij,mj->m", error, np.linalg.inv(found.covariance), error)
    assert np.mean(distance < chi2.ppf(0.95, 6)) > 0.9
    assert (np.abs(found.offset) < 6 * found.offset_sigma).all()


def test_the_angle_and_the_distance_of_the_axes_carry_honest_uncertainties():
    square = random_cells(22, CELLS)
    again = solve_cells(square.first, square.second, square.sigma_first, square.sigma_second)
    inside = np.mean(np.abs(again.angle - np.pi / 2) < 1.959964 * again.angle_sigma)
    assert COVERED[0] < inside < COVERED[1]


def _axes(rng):
    half = rng.normal(size=(4, 4))
    return Axes(rng.normal(size=3), exp_so3(rng.normal(size=3)), half @ half.T)


def _nudged(axes, step):
    e1, e2, n = axes.basis
    n = n + step[2] * e1 + step[3] * e2
    return Axes(
        axes.point + step[0] * e1 + step[1] * e2, np.stack([e1, e2, n / np.linalg.norm(n)]), axes.covariance
    )


@pytest.mark.parametrize("seed", range(5))
def test_the_analytic_covariance_is_the_one_of_central_differences(seed):
    rng = np.random.default_rng(seed)
    axes, towards, h = [_axes(rng), _axes(rng)], 10 * rng.normal(size=3), 1e-6
    centre = base_frames(*axes, towards, unclear=0.0)
    pose, total = Pose(centre.matrices), np.zeros((6, 6))
    gap_var = angle_var = 0.0
    for which in (0, 1):
        columns, gaps, angles = [], [], []
        for k in range(4):
            ends = []
            for sign in (1, -1):
                pair = list(axes)
                pair[which] = _nudged(pair[which], sign * h * np.eye(4)[k])
                ends.append(base_frames(*pair, towards, unclear=0.0))
            up, down = Pose(ends[0].matrices), Pose(ends[1].matrices)
            columns.append(
                np.concatenate(
                    [pose.rotation.T @ (up.position - down.position), (down.inverse() @ up).rotvec]
                )
                / (2 * h)
            )
            gaps.append((ends[0].offset - ends[1].offset) / (2 * h))
            angles.append((ends[0].angle - ends[1].angle) / (2 * h))
        j, covariance = np.array(columns).T, axes[which].covariance
        total += j @ covariance @ j.T
        gap_var += np.array(gaps) @ covariance @ np.array(gaps)
        angle_var += np.array(angles) @ covariance @ np.array(angles)
    np.testing.assert_allclose(centre.covariance, total, rtol=ANALYTIC, atol=ANALYTIC * np.abs(total).max())
    assert centre.offset_sigma == pytest.approx(np.sqrt(gap_var), rel=ANALYTIC)
    assert centre.angle_sigma == pytest.approx(np.sqrt(angle_var), rel=ANALYTIC)


def test_turning_an_axis_round_keeps_its_uncertainty_in_space():
    rng = np.random.default_rng(9)
    axes = _axes(rng)
    back = axes.reversed_where(np.array(True))
    np.testing.assert_allclose(back.direction, -axes.direction)
    assert np.linalg.det(back.basis) == pytest.approx(np.linalg.det(axes.basis))
    for basis_rows in (slice(0, 2), slice(2, 4)):
        before = axes.basis[:2].T @ axes.covariance[basis_rows, basis_rows] @ axes.basis[:2]
        after = back.basis[:2].T @ back.covariance[basis_rows, basis_rows] @ back.basis[:2]
        np.testing.assert_allclose(after, before, atol=1e-12)
