"""The result of a fit: read by name, printed as a table, and not to be written."""

import numpy as np
import pytest

from app.estimation import Fit


def example(**changes):
    values = {
        "names": ("x", "stiffness"),
        "units": ("m", "Nm/rad"),
        "values": np.array([0.0012345, 51234.5]),
        "covariance": np.diag([1e-8, np.inf]),
        "residuals": np.array([3e-3, -4e-3]),
        "dof": 1,
        "sigma": 0.005,
        "sigma_source": "stated",
        "rank": 1,
        "condition": np.inf,
    }
    return Fit(**{**values, **changes})


def test_values_are_read_by_name():
    fit = example()
    assert fit["stiffness"] == 51234.5
    with pytest.raises(ValueError, match="tuple"):
        fit["mass"]


def test_rms_and_sum_of_squares_are_of_the_residuals():
    fit = example()
    assert fit.rms == pytest.approx(np.sqrt(12.5e-6))
    assert fit.sse == pytest.approx(25e-6)
    assert example(residuals=np.empty(0)).rms == 0.0


def test_its_arrays_are_copies_that_cannot_be_written():
    values = np.array([1.0, 2.0])
    fit = example(values=values)
    values[0] = 9.0
    assert fit["x"] == 1.0
    for array in (fit.values, fit.covariance, fit.residuals):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0


def test_the_summary_shows_value_error_unit_and_what_is_wrong():
    text = example(at_bound=("x",), converged=False, message="iterations ran out").summary()
    lines = text.splitlines()
    assert lines[0].split() == ["parameter", "value", "std", "error", "unit"]
    assert lines[1].split()[:3] == ["x", "0.0012345", "0.0001"] and lines[1].endswith("at its bound")
    assert "inf" in lines[2] and lines[2].endswith("Nm/rad")
    assert "rank 1 of 2" in text and "NOT CONVERGED: iterations ran out" in text


def test_the_summary_prints_nothing_by_itself(capsys):
    example().summary()
    assert capsys.readouterr().out == ""
