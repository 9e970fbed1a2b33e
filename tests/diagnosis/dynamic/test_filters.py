"""Speed and acceleration of noisy samples, evenly timed and not."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.models.dynamic.filters import differentiate, noise_of

STEP, SIGMA = 0.008, 5e-4  # s, rad/s
JITTER = 0.2  # of a step


@pytest.fixture
def moving():
    """Sample times, with jitter and without, and a motion's speed and acceleration at any time."""
    rng = np.random.default_rng(8)
    even = STEP * np.arange(3000)
    shaken = np.round(even + JITTER * STEP * rng.uniform(-0.5, 0.5, len(even)), 6)
    pace = np.array([0.7, 2.1, 3.9])
    return (
        rng,
        {"even": even, "shaken": shaken - shaken[0]},
        lambda t: (-np.cos(np.outer(t, pace)) @ (0.6 / pace), np.sin(np.outer(t, pace)) @ np.full(3, 0.6)),
        lambda t: np.cos(np.outer(t, pace)) @ (0.6 * pace),
    )


def test_white_noise_is_told_in_its_size():
    noise = np.random.default_rng(1).normal(0, SIGMA, 20_000)
    assert noise_of(noise) == pytest.approx(SIGMA, rel=0.03)


def test_samples_that_jitter_give_the_acceleration_that_even_ones_give(moving):
    rng, times, path, acceleration = moving
    errors = {}
    for kind, t in times.items():
        q, qd = path(t)
        noisy = qd + SIGMA * rng.normal(size=len(t))
        _, _, qdd, used = differentiate(t, q[:, None], noisy[:, None], [slice(0, len(t))], STEP)
        errors[kind] = float(np.std(qdd[:, 0] - acceleration(t)))
        assert used.acceleration[0] < 3 * errors[kind]
    assert errors["shaken"] < 1.5 * errors["even"] < 0.006
