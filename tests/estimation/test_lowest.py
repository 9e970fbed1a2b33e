"""The lowest point of a function of one number: scipy's bounded search takes the same steps."""

from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from app.estimation.lowest import lowest

FUNCTIONS = {
    "parabola": lambda x: (x - 0.3) ** 2,
    "valley": lambda x: abs(x - 0.71) ** 1.5,
    "wave": lambda x: np.sin(7 * x) + 0.1 * x,
    "falls to an end": lambda x: -np.exp(x),
    "flat": lambda x: 1.0,
}


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("bounds", [(-1.0, 1.5), (0.2, 0.9)])
def test_same_steps_as_scipy(name, bounds):
    ours, theirs = [], []
    found = lowest(lambda x: ours.append(x) or FUNCTIONS[name](x), *bounds, within=1e-3, most=20)
    other: Any = minimize_scalar(
        lambda x: theirs.append(x) or FUNCTIONS[name](x),
        bounds=bounds, method="bounded", options={"maxiter": 20, "xatol": 1e-3},
    )  # fmt: skip
    assert len(ours) == len(theirs)
    assert found == pytest.approx(other.x, abs=1e-12)
    assert ours == pytest.approx(theirs, abs=1e-12)
