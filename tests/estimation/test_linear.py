"""Linear least squares: the solution, its covariance against chance itself, and what cannot be determined."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.estimation import solve_linear
from app.estimation.linear import covariance_from_jacobian

DRAWS = 4000
MONTE_CARLO_TOLERANCE = 6 / np.sqrt(2 * DRAWS)  # six standard errors of a variance's square root
NAMES, UNITS = ("a", "b", "c"), ("m", "m", "rad")


def problem(seed=0, rows=20, columns=3):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(rows, columns)), rng.normal(size=columns), rng


@given(st.integers(0, 2**31))
def test_exact_data_give_the_exact_parameters(seed):
    matrix, truth, _ = problem(seed)
    fit = solve_linear(matrix, matrix @ truth, names=NAMES, units=UNITS)
    assert np.abs(fit.values - truth).max() < 1e-10
    assert fit.rms < 1e-12 and fit.rank == 3 and fit.dof == 17


def test_it_agrees_with_numpy():
    matrix, truth, rng = problem(1)
    rhs = matrix @ truth + rng.normal(0, 0.1, 20)
    expected, sse, *_ = np.linalg.lstsq(matrix, rhs, rcond=None)
    fit = solve_linear(matrix, rhs, names=NAMES, units=UNITS)
    assert np.allclose(fit.values, expected, atol=1e-12)
    assert fit.sse == pytest.approx(sse[0])
    assert fit.sigma == pytest.approx(np.sqrt(sse[0] / 17)) and fit.sigma_source == "residual"


def test_the_covariance_is_that_of_many_repeats():
    matrix, truth, rng = problem(2)
    matrix[:, 2] = 0.9 * matrix[:, 1] + 0.1 * matrix[:, 2]  # correlated on purpose
    sigma = 0.3
    values = np.array(
        [
            solve_linear(
                matrix, matrix @ truth + rng.normal(0, sigma, 20), names=NAMES, units=UNITS, sigma=sigma
            ).values
            for _ in range(DRAWS)
        ]
    )
    fit = solve_linear(matrix, matrix @ truth, names=NAMES, units=UNITS, sigma=sigma)
    assert fit.sigma_source == "stated"
    spread = values.std(axis=0)
    assert np.abs(spread / fit.standard_errors - 1).max() < MONTE_CARLO_TOLERANCE
    correlation = np.corrcoef(values.T)[1, 2]
    expected = fit.covariance[1, 2] / np.prod(fit.standard_errors[1:])
    assert correlation == pytest.approx(expected, abs=0.02)


def test_two_columns_that_are_one_have_no_value_of_their_own_and_the_third_keeps_its():
    matrix, truth, rng = problem(3)
    matrix[:, 1] = 2.0 * matrix[:, 0]
    rhs = matrix @ truth + rng.normal(0, 0.1, 20)
    fit = solve_linear(matrix, rhs, names=NAMES, units=UNITS, sigma=0.1)
    assert fit.rank == 2 and fit.dof == 18 and np.isinf(fit.condition)
    assert np.isinf(fit.standard_errors[:2]).all()
    alone = solve_linear(matrix[:, [0, 2]], rhs, names=NAMES[:2], units=UNITS[:2], sigma=0.1)
    assert fit.values[2] == pytest.approx(alone.values[1])
    assert fit.standard_errors[2] == pytest.approx(alone.standard_errors[1])
    assert fit.sse == pytest.approx(alone.sse)


def test_a_column_of_zeros_is_not_determined_and_gets_zero():
    matrix, truth, _ = problem(4)
    matrix[:, 1] = 0.0
    fit = solve_linear(matrix, matrix @ truth, names=NAMES, units=UNITS, sigma=1.0)
    assert fit.rank == 2 and fit["b"] == 0.0 and np.isinf(fit.standard_errors[1])
    assert fit["a"] == pytest.approx(truth[0])


def test_fewer_rows_than_columns_still_answer_and_say_the_rank():
    fit = solve_linear(np.ones((1, 3)), np.array([3.0]), names=NAMES, units=UNITS)
    assert fit.rank == 1 and fit.dof == 0
    assert np.isnan(fit.sigma)
    assert np.allclose(fit.values, 1.0)


@given(st.floats(1e-6, 1e6), st.floats(1e-6, 1e6))
def test_rank_and_condition_do_not_depend_on_units(scale_a, scale_b):
    matrix, _, _ = problem(5)
    _, rank, condition = covariance_from_jacobian(matrix, 1.0)
    _, rank_scaled, condition_scaled = covariance_from_jacobian(matrix * [scale_a, scale_b, 1.0], 1.0)
    assert rank == rank_scaled == 3
    assert condition_scaled == pytest.approx(condition, rel=1e-8)


def test_nothing_to_estimate_is_no_error():
    covariance, rank, condition = covariance_from_jacobian(np.zeros((5, 0)), 1.0)
    assert covariance.shape == (0, 0) and rank == 0 and condition == 1.0
