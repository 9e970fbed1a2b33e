import math

import pytest

from app.estimation import HALF, plus_minus, reach


def test_half_an_interval_is_that_of_a_normal_law_and_wider_with_few_degrees_of_freedom():
    assert pytest.approx(1.959964, abs=1e-6) == HALF
    assert reach(3, dimensions=1) == pytest.approx(3.1824, abs=1e-4)  # Student's t, 0.975, 3


def test_the_95_percent_set_how_many_digits_the_value_gets():
    assert plus_minus(12.3456, 0.0321, "mm") == "12.346 ± 0.063 mm (95%)"
    assert plus_minus(12345.6, 321.0) == "12350 ± 630 (95%)"
    assert plus_minus(1e-12, 1e-13, "m") == "1e-12 ± 2e-13 m (95%)"
    assert plus_minus(12.3456, 0.0321, "mm", marked=False) == "12.346 ± 0.063 mm"


@pytest.mark.parametrize("std", [0.0, math.nan, math.inf])
def test_what_carries_no_uncertainty_is_given_none(std):
    assert plus_minus(0.5, std, "kg") == "0.5 kg"
