"""Non-linear least squares: converges, says when it does not, and its covariance is that of many repeats."""

import numpy as np
import pytest

from app.estimation import gauss_newton
from app.geometry import exp_so3

T = np.linspace(0.0, 2.0, 25)
TRUTH = np.array([2.0, 1.3])
NAMES, UNITS = ("amplitude", "rate"), ("m", "1/s")
DRAWS = 1500
MONTE_CARLO_TOLERANCE = 6 / np.sqrt(2 * DRAWS)


def decay(measured):
    """Residual and Jacobian of amplitude * exp(-rate t)."""

    def function(x):
        shape = np.exp(-x[1] * T)
        return measured - x[0] * shape, np.stack([shape, -x[0] * T * shape], axis=1)

    return function


def exact():
    return TRUTH[0] * np.exp(-TRUTH[1] * T)


@pytest.mark.parametrize("start", [[1.0, 1.0], [5.0, 0.1], [0.1, 3.0]])
def test_exact_data_give_the_exact_parameters(start):
    fit = gauss_newton(decay(exact()), np.array(start), names=NAMES, units=UNITS)
    assert fit.converged, fit.message
    assert np.abs(fit.values - TRUTH).max() < 1e-8


def test_the_covariance_is_that_of_many_repeats():
    rng = np.random.default_rng(0)
    sigma = 0.02
    values = []
    for _ in range(DRAWS):
        measured = exact() + rng.normal(0, sigma, len(T))
        values.append(gauss_newton(decay(measured), TRUTH, names=NAMES, units=UNITS, sigma=sigma).values)
    fit = gauss_newton(decay(exact()), TRUTH, names=NAMES, units=UNITS, sigma=sigma)
    spread = np.std(values, axis=0)
    assert np.abs(spread / fit.standard_errors - 1).max() < MONTE_CARLO_TOLERANCE


def test_without_a_stated_noise_it_is_taken_from_what_is_left():
    measured = exact() + np.random.default_rng(1).normal(0, 0.05, len(T))
    fit = gauss_newton(decay(measured), TRUTH, names=NAMES, units=UNITS)
    assert fit.sigma_source == "residual"
    assert fit.sigma == pytest.approx(np.sqrt(fit.sse / (len(T) - 2)))
    assert 0.03 < fit.sigma < 0.08


def test_running_out_of_iterations_is_said_and_not_raised():
    fit = gauss_newton(decay(exact()), np.array([5.0, 0.1]), names=NAMES, units=UNITS, max_iterations=1)
    assert not fit.converged and "iterations" in fit.message
    assert "NOT CONVERGED" in fit.summary()


def test_a_jacobian_of_the_wrong_sign_is_stuck_and_not_called_converged():
    def lying(x):
        residual, jacobian = decay(exact())(x)
        return residual, -jacobian

    fit = gauss_newton(lying, np.array([1.0, 1.0]), names=NAMES, units=UNITS)
    assert not fit.converged and "no step lowers" in fit.message


def test_a_parameter_stops_at_its_bound_is_named_and_the_other_goes_on_to_its_best():
    upper = np.array([np.inf, 1.0])
    fit = gauss_newton(
        decay(exact()),
        np.array([1.0, 0.5]),
        names=NAMES,
        units=UNITS,
        lower=np.array([0.0, 0.0]),
        upper=upper,
    )
    assert fit.at_bound == ("rate",) and fit["rate"] == 1.0
    shape = np.exp(-T)
    assert fit["amplitude"] == pytest.approx(shape @ exact() / (shape @ shape), rel=1e-6)
    assert "at its bound" in fit.summary()


def test_a_start_outside_the_bounds_is_brought_inside():
    fit = gauss_newton(
        decay(exact()),
        np.array([1.0, 50.0]),
        names=NAMES,
        units=UNITS,
        lower=np.array([0.0, 0.0]),
        upper=np.array([10.0, 3.0]),
    )
    assert np.allclose(fit.values, TRUTH, atol=1e-6) and fit.at_bound == ()


def test_a_parameter_that_nothing_depends_on_is_not_determined_and_stays():
    def function(x):
        residual, jacobian = decay(exact())(x[:2])
        return residual, np.column_stack([jacobian, np.zeros(len(T))])

    fit = gauss_newton(
        function, np.array([1.0, 1.0, 7.0]), names=(*NAMES, "idle"), units=(*UNITS, "m"), sigma=0.1
    )
    assert fit.rank == 2 and fit["idle"] == 7.0 and np.isinf(fit.standard_errors[2])
    assert np.allclose(fit.values[:2], TRUTH)


def test_rotations_are_updated_on_their_own_manifold():
    truth = exp_so3(np.array([2.0, -1.5, 1.0]))
    points = np.random.default_rng(2).normal(size=(6, 3))
    seen = points @ truth.T

    def function(flat):
        r = flat.reshape(3, 3)
        moved = points @ r.T
        jacobian = np.zeros((18, 3))
        for k in range(3):
            jacobian[:, k] = np.cross(np.eye(3)[k], moved).ravel()
        return (seen - moved).ravel(), jacobian

    fit = gauss_newton(
        function,
        np.eye(3).ravel(),
        names=("x", "y", "z"),
        units=("rad",) * 3,
        update=lambda flat, step: (exp_so3(step) @ flat.reshape(3, 3)).ravel(),
    )
    assert fit.converged
    assert np.abs(fit.values.reshape(3, 3) - truth).max() < 1e-9


def test_a_region_where_the_model_is_not_defined_is_stepped_back_from():
    def function(x):
        with np.errstate(invalid="ignore", divide="ignore"):
            root = np.sqrt(x)
            return np.array([1e-3]) - root, 0.5 / root[:, None]

    fit = gauss_newton(function, np.array([4.0]), names=("x",), units=("",), max_iterations=100)
    assert np.isfinite(fit.values).all() and fit.values[0] >= 0
