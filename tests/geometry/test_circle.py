"""Circles in space by orthogonal distance."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from app.geometry import exp_so3
from app.geometry.circle import fit_axis

SAME_MINIMUM = 1e-6  # relative, of the squared sum against scipy's
EXACT = 1e-9  # m
COVERED = (0.93, 0.97)  # share of trials inside the 95% region
FIGURES_AGREE = 0.06  # relative, of an error over many trials against its prediction


def _arc(rng, n, span, radius=1.5, noise=0.0, count=None):
    t = np.linspace(0, span, n)
    flat = radius * np.stack([np.cos(t), np.sin(t), np.zeros(n)], -1)
    shape = (n, 3) if count is None else (count, n, 3)
    rotation, centre = exp_so3(rng.normal(size=3)), rng.normal(size=3)
    return (flat + noise * rng.normal(size=shape)) @ rotation.T + centre, rotation[:, 2], centre


@pytest.mark.parametrize("degrees", [15, 60, 180, 350])
def test_points_on_a_circle_give_it_back(degrees):
    rng = np.random.default_rng(degrees)
    points, axis, centre = _arc(rng, 12, np.radians(degrees))
    fit = fit_axis(points)
    assert fit.converged
    assert abs(abs(fit.direction @ axis) - 1) < EXACT
    np.testing.assert_allclose(fit.centres[0], centre, atol=EXACT)
    assert abs(fit.radii[0] - 1.5) < EXACT
    assert np.degrees(np.ptp(np.unwrap(fit.azimuths))) == pytest.approx(degrees, abs=1e-6)


def test_the_minimum_is_the_one_a_general_solver_finds():
    rng = np.random.default_rng(5)
    for span in (0.4, 1.5, 4.0):
        points, _, _ = _arc(rng, 15, span, noise=0.01)
        fit = fit_axis(points)

        def distances(x, points=points):
            n = np.array([np.sin(x[3]) * np.cos(x[4]), np.sin(x[3]) * np.sin(x[4]), np.cos(x[3])])
            d = points - x[:3]
            h = d @ n
            return np.concatenate([h, np.linalg.norm(d - h[:, None] * n, axis=1) - x[5]])

        n = fit.direction
        start = [*fit.centres[0], np.arccos(n[2]), np.arctan2(n[1], n[0]), fit.radii[0]]
        peer = least_squares(distances, np.array(start) * 1.001, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        assert fit.sse <= 2 * peer.cost * (1 + SAME_MINIMUM)


def test_the_covariance_is_what_many_trials_scatter_by():
    rng = np.random.default_rng(6)
    points, axis, centre = _arc(rng, 12, np.pi / 2, noise=5e-5, count=4000)
    fit = fit_axis(points)
    covariance = fit.covariance * 5e-5**2
    tilt = np.arccos(np.clip(np.abs(fit.direction @ axis), -1, 1))
    predicted = np.sqrt(np.median(covariance[:, 2, 2] + covariance[:, 3, 3]))
    assert np.sqrt(np.mean(tilt**2)) == pytest.approx(predicted, rel=FIGURES_AGREE)
    off = np.linalg.norm(fit.centres[:, 0] - centre, axis=1)
    expected = np.sqrt(np.median(covariance[:, 0, 0] + covariance[:, 1, 1] + covariance[:, 4, 4]))
    assert np.sqrt(np.mean(off**2)) == pytest.approx(expected, rel=FIGURES_AGREE)


@pytest.mark.parametrize(
    ("degrees", "axis_deg"),
    [(20, 0.085), (90, 0.0045), (180, 0.0015)],
    ids=["20", "90", "180"],
)
def test_short_arcs_cost_what_the_errata_say(degrees, axis_deg):
    """12 points, 0.05 mm, radius 1500 mm: mean error of the axis as it was found by simulation elsewhere."""
    rng = np.random.default_rng(7)
    points, axis, _ = _arc(rng, 12, np.radians(degrees), noise=5e-5, count=4000)
    tilt = np.degrees(np.arccos(np.clip(np.abs(fit_axis(points).direction @ axis), -1, 1)))
    assert tilt.mean() == pytest.approx(axis_deg, rel=FIGURES_AGREE)


def test_several_reflectors_share_one_axis_and_beat_each_alone():
    rng = np.random.default_rng(8)
    t = np.linspace(0, 1.2, 10)
    parts, groups = [], []
    for g, (radius, height) in enumerate([(1.5, 0.0), (0.7, 0.4), (0.001, -0.2)]):
        parts.append(np.stack([radius * np.cos(t + g), radius * np.sin(t + g), np.full(10, height)], -1))
        groups += [g] * 10
    points = np.concatenate(parts) + 2e-5 * rng.normal(size=(30, 3))
    together = fit_axis(points, groups=np.array(groups))
    alone = fit_axis(points[:10])
    assert abs(together.direction[2]) > 1 - 1e-8
    assert (
        together.covariance[2, 2] + together.covariance[3, 3]
        < alone.covariance[2, 2] + alone.covariance[3, 3]
    )
    sign = np.sign(together.direction[2])
    np.testing.assert_allclose(together.radii, [1.5, 0.7, 0.001], atol=2e-4)
    np.testing.assert_allclose(sign * np.diff(together.heights), [0.4, -0.6], atol=2e-4)


def test_rows_without_weight_are_not_there():
    rng = np.random.default_rng(9)
    points, _, _ = _arc(rng, 14, 2.0, noise=1e-4)
    wild = points.copy()
    wild[5] += 3.0
    weights = np.ones(14)
    weights[5] = 0.0
    kept, without = fit_axis(wild, weights), fit_axis(np.delete(points, 5, axis=0))
    np.testing.assert_allclose(kept.centres, without.centres, atol=EXACT)
    np.testing.assert_allclose(
        kept.covariance[2:4, 2:4].trace(), without.covariance[2:4, 2:4].trace(), rtol=1e-6
    )
    assert kept.dof == without.dof


def test_a_batch_gives_what_single_fits_give():
    rng = np.random.default_rng(10)
    points, _, _ = _arc(rng, 12, 1.0, noise=1e-4, count=5)
    together = fit_axis(points)
    for k in range(5):
        alone = fit_axis(points[k])
        np.testing.assert_allclose(together.centres[k], alone.centres, atol=EXACT)
        np.testing.assert_allclose(together.sse[k], alone.sse, rtol=1e-6)


def test_points_on_a_line_leave_infinite_variances_and_raise_nothing():
    points = np.linspace(0, 1, 8)[:, None] * np.array([1.0, 2.0, 3.0])
    fit = fit_axis(points)
    assert not np.isfinite(fit.covariance[2:4, 2:4]).all() or not fit.converged


def test_the_95_percent_region_of_a_circle_holds_95_percent():
    rng = np.random.default_rng(11)
    points, axis, centre = _arc(rng, 12, 2.0, noise=5e-5, count=2000)
    fit = fit_axis(points)
    sign = np.sign(fit.direction @ axis)
    e = fit.basis[:, :2]
    # Truth seen from the fit: tilt and shift along e1, e2.
    tilt = np.einsum("mjk,k->mj", e, axis) * sign[:, None]
    foot = centre - fit.point
    along = np.einsum("mk,mk->m", foot, fit.direction)
    shift = np.einsum("mjk,mk->mj", e, foot) - along[:, None] * tilt
    error = np.concatenate([shift, tilt], axis=1)
    inverse = np.linalg.inv(fit.covariance[:, :4, :4] * 5e-5**2)
    chi = np.einsum("mi,mij,mj->m", error, inverse, error)
    inside = np.mean(chi < 9.487729)  # chi-squared, 4 degrees of freedom, 95%
    assert COVERED[0] < inside < COVERED[1]
