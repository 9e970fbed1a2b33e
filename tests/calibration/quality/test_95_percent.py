"""One measure of certainty on every screen: the region that holds the truth in 95 of 100 cases."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from app.calibration.next_touch import predicted_covariance, predicted_error
from app.calibration.quality.region import ellipsoid
from app.geometry import exp_so3
from app.texts import TEXTS

NOISE = 3e-4  # m
DRAWS = 4000
CHANCE = 0.011  # three standard errors of a share of 0.95 in so many draws


@pytest.fixture
def rotations():
    return exp_so3(np.random.default_rng(4).normal(0.0, 0.5, (5, 3)))


def test_what_a_touch_would_bring_is_said_in_the_measure_the_result_is_said_in(rotations):
    covariance = predicted_covariance(rotations, NOISE)
    result = SimpleNamespace(covariance=covariance, dof=0, tool_point=np.zeros(3))
    assert predicted_error(rotations, NOISE) == pytest.approx(
        float(ellipsoid(result).semi_axes[0]), rel=1e-12
    )


def test_the_true_tool_lies_in_the_predicted_region_in_95_of_100_cases(rotations):
    """Solved anew each time from noisy touches of one spike: nothing of the prediction is used."""
    rng = np.random.default_rng(7)
    tool, spike = np.array([0.03, -0.02, 0.2]), np.array([1.0, 0.1, 0.4])
    flanges = spike - rotations @ tool
    design = np.concatenate([np.hstack([r, -np.eye(3)]) for r in rotations])
    noisy = flanges + rng.normal(0.0, NOISE, (DRAWS, *flanges.shape))
    found = np.linalg.lstsq(design, -noisy.reshape(DRAWS, -1).T, rcond=None)[0][:3].T
    region = ellipsoid(
        SimpleNamespace(covariance=predicted_covariance(rotations, NOISE), dof=0, tool_point=tool)
    )
    inside = np.mean([region.holds(point) for point in found])
    assert abs(inside - 0.95) < CHANCE


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_screen_speaks_of_one_sigma(language):
    said = {k: v for k, v in TEXTS.languages[language].items() if re.search(r"one.sigma|1\s?σ|一倍标准差", v)}
    assert not said
