"""What measuring adds: noise of several kinds, and rows that went wrong."""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

KINDS = ("gaussian", "coloured", "heavy", "laplace", "mixed")
MEMORY = 0.6  # of coloured noise, from one row to the next
TAIL = 4.0  # degrees of freedom of Student's t
WIDE, OFTEN = 4.0, 0.1  # of mixed noise: how much wider the wide part is, and how often it comes


def draw_noise(rng: np.random.Generator, shape: tuple[int, ...], sigma: float, kind: str) -> np.ndarray:
    """Noise of standard deviation `sigma`; coloured along the first dimension.

    Args:
        kind: "gaussian", "coloured" (first-order autoregressive), "heavy" (Student's t), "laplace" (falls off
            exponentially) or "mixed" (now and then a reading from a wider Gaussian).
    """
    if kind == "heavy":
        return sigma * rng.standard_t(TAIL, shape) / np.sqrt(TAIL / (TAIL - 2.0))
    if kind == "laplace":
        return sigma * rng.laplace(scale=np.sqrt(0.5), size=shape)
    white = rng.normal(size=shape)
    if kind == "mixed":
        wide = np.where(rng.random(shape) < OFTEN, WIDE, 1.0)
        return sigma * white * wide / np.sqrt(1.0 + OFTEN * (WIDE**2 - 1.0))
    if kind == "coloured":
        white[1:] *= np.sqrt(1.0 - MEMORY**2)
        white = np.asarray(lfilter([1.0], [1.0, -MEMORY], white, axis=0))
    return sigma * white


def draw_outliers(
    rng: np.random.Generator, rows: int, share: float, size: float
) -> tuple[np.ndarray, np.ndarray]:
    """Which rows went wrong and by how much.

    Returns:
        indices (o,), and jumps (rows, 3) of 1 to 4 times `size` in any direction, zero elsewhere.
    """
    count = round(share * rows)
    chosen = np.sort(rng.choice(rows, count, replace=False))
    jump = np.zeros((rows, 3))
    direction = rng.normal(size=(count, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    jump[chosen] = direction * size * rng.uniform(1.0, 4.0, (count, 1))
    return chosen, jump
