"""The noise's size and memory, learnt from what a fit with very many columns leaves."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from app.diagnosis.motion.noise import _left
from app.diagnosis.motion.whitening import estimate

ROWS, SIGMA = 2000, 0.3


def _slow_columns(rng: np.random.Generator, count: int) -> np.ndarray:
    """Sums of sines below a sixth of the sampling's own frequency, as laws and curves of a motion are."""
    t = np.arange(ROWS)
    return np.stack([np.sin(rng.uniform(0, 0.5) * t + rng.uniform(0, 6)) for _ in range(count)])


@pytest.mark.parametrize("memory", [0.0, 0.6])
def test_what_a_large_fit_takes_of_the_noise_is_put_back(memory):
    rng = np.random.default_rng(4)
    white = SIGMA * np.sqrt(1 - memory**2) * rng.normal(size=ROWS)
    noise = np.asarray(lfilter([1.0], [1.0, -memory], white))
    usable = np.ones(ROWS, bool)
    usable[600:640] = False
    left, taken = _left(_slow_columns(rng, 150), noise, usable)
    found = estimate(left, usable, [slice(0, 900), slice(900, ROWS)], taken)
    assert len(found.lags) == (memory > 0)
    assert found.lags == pytest.approx([memory] * len(found.lags), abs=0.06)
    assert found.spread == pytest.approx(SIGMA, rel=0.06)


def test_few_rows_are_taken_for_white():
    rng = np.random.default_rng(5)
    usable = np.zeros(ROWS, bool)
    usable[:60] = True
    left, taken = _left(_slow_columns(rng, 10), rng.normal(size=ROWS), usable)
    assert not len(estimate(left, usable, [slice(0, ROWS)], taken).lags)
