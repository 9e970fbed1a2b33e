"""Curves without a law: what a residual follows, whatever its shape. They test names and what is left over."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.motion._state import State

#: Driver -> number of knots.
KNOTS = {"own_angle": 9, "gravity_torque": 6, "acceleration": 6, "time": 25}
SPEED_KNOTS = 6
FEATURES = 16  # waves over the joint space
_SEED = 7


def curves(state: State, joint: int) -> dict[str, np.ndarray]:
    """Driver -> (m, k) columns for joint (from 0); those that do not vary are left out."""
    out: dict[str, np.ndarray] = {}
    signals = {
        "own_angle": state.q[:, joint],
        "gravity_torque": state.gravity_torque[:, joint],
        "acceleration": state.qdd[:, joint],
        "time": state.t,
    }
    for driver, x in signals.items():
        if np.ptp(x) > 1e-6:
            out[driver] = hats(x, _quantiles(x, KNOTS[driver]))
    if state.moves(joint):
        out["speed"] = speed_curve(state.qd[:, joint])
    out["pose"] = waves(state, joint)
    return out


def hats(x: np.ndarray, knots: np.ndarray) -> np.ndarray:
    """(m, k) piecewise linear functions, one a knot; flat beyond the ends."""
    out = np.zeros((len(knots), len(x)))  # a function lies next to itself in memory
    low = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(knots) - 2)
    share = np.clip((x - knots[low]) / (knots[low + 1] - knots[low]), 0.0, 1.0)
    at = np.arange(len(x))
    out[low, at], out[low + 1, at] = 1.0 - share, share
    return out.T


def speed_curve(qd: np.ndarray) -> np.ndarray:
    """(m, 2 k): any curve of speed, its two directions apart, with a step at zero."""
    knots = _quantiles(np.abs(qd), SPEED_KNOTS)
    size = hats(np.abs(qd), knots)
    return np.concatenate([size * (qd > 0)[:, None], size * (qd < 0)[:, None]], axis=1)


def waves(state: State, joint: int) -> np.ndarray:
    """(m, k) random waves over all positions and speeds: what follows the pose in no simple way.

    Source: Rahimi, Recht (2007), random features of a Gaussian kernel.
    """
    rng = np.random.default_rng(_SEED + joint)
    x = np.concatenate([state.q, state.qd], axis=1)
    scale = np.std(x, axis=0)
    x = x[:, scale > 1e-6] / scale[scale > 1e-6]
    directions = rng.normal(0.0, 0.7, (x.shape[1], FEATURES))
    # Two or three joints a wave: a wave over all of them is no more than noise.
    mask = np.zeros_like(directions)
    for k in range(FEATURES):
        mask[rng.choice(x.shape[1], min(2, x.shape[1]), replace=False), k] = 1.0
    return np.sin(x @ (1.5 * directions * mask) + rng.uniform(0, 2 * np.pi, FEATURES))


def _quantiles(x: np.ndarray, count: int) -> np.ndarray:
    low, high = np.quantile(x, [0.01, 0.99])
    return np.linspace(low, high, count) + 1e-12 * np.arange(count)
