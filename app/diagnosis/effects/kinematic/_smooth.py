"""Smooth curves without a law: cosines over the range that was recorded, fading out beyond it."""

from __future__ import annotations

from itertools import product

import numpy as np

#: Of the range, beyond either end: over this distance (one sigma) a curve fades to nothing.
_FADE = 0.15


def normalised(values: np.ndarray, low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """Values brought to 0..1 over [low, high] and held there, and (m,) how much of the curve is left beyond."""
    z = (values - low) / max(high - low, 1e-12)
    inside = np.clip(z, 0.0, 1.0)
    return inside, np.exp(-0.5 * ((z - inside) / _FADE) ** 2)


def cosines(values: np.ndarray, low: float, high: float, count: int) -> np.ndarray:
    """(m, count): cos(k pi z), k = 1..count, z the values (m,) brought to 0..1."""
    z, left = normalised(values, low, high)
    return np.cos(np.pi * z[:, None] * np.arange(1, count + 1)) * left[:, None]


def smoothness(count: int) -> np.ndarray:
    """(count,) relative widths: one over k, so that slow waves are expected larger than fast ones."""
    return 1.0 / np.arange(1.0, count + 1)


def orders(dimensions: int, degree: int) -> np.ndarray:
    """(b, dimensions) orders of products of cosines, total order 1..degree."""
    every = [o for o in product(range(degree + 1), repeat=dimensions) if 1 <= sum(o) <= degree]
    return np.array(every)


def tensor(values: np.ndarray, low: np.ndarray, high: np.ndarray, which: np.ndarray) -> np.ndarray:
    """(m, b) products of cosines of values (m, d) over a box, by orders (b, d)."""
    out, left = np.ones((len(values), len(which))), np.ones(len(values))
    for d in range(values.shape[1]):
        z, here = normalised(values[:, d], float(low[d]), float(high[d]))
        out = out * np.cos(np.pi * z[:, None] * which[:, d])
        left = left * here
    return out * left[:, None]
