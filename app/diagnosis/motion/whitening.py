"""Noise of each joint's torque: its size and how it hangs together in time (autoregression)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

MOST_LAGS = 6


@dataclass(frozen=True, eq=False)
class Whitener:
    """Turns one joint's rows into rows with noise of size one that do not hang together.

    Args:
        lags: (p,) coefficients: e_t = sum lags_k e_(t-k) + innovation.
        sigma: standard deviation of the innovation [Nm].
        weight: (M,) 1 where the row counts, else 0.
    """

    lags: np.ndarray
    sigma: float
    weight: np.ndarray

    def __call__(self, columns: np.ndarray) -> np.ndarray:
        """(M, k) or (M,) -> the same shape."""
        out = np.array(columns, float)
        for k, lag in enumerate(self.lags, 1):
            out[k:] -= lag * columns[:-k]
        weight = self.weight / self.sigma
        return out * (weight if columns.ndim == 1 else weight[:, None])

    @cached_property
    def _response(self) -> np.ndarray:
        """What one innovation leaves behind, row by row."""
        lags, response = self.lags.tolist(), [1.0]
        for i in range(1, 600):
            response.append(sum(response[i - k] * lag for k, lag in enumerate(lags[:i], 1)))
        return np.array(response)

    @cached_property
    def spread(self) -> float:
        """Standard deviation of the noise itself [Nm], innovation and what it drags along."""
        return float(self.sigma * np.linalg.norm(self._response))

    def correlation(self) -> np.ndarray:
        """(400,) correlation of rows so many apart."""
        response = self._response
        products = np.array([response[: len(response) - k] @ response[k:] for k in range(400)])
        return products / products[0]


def weights(usable: np.ndarray, runs: list[slice], lags: int) -> np.ndarray:
    """(M,) 1 where a row and the `lags` rows before it are usable and of one run."""
    good = usable.astype(bool).copy()
    for run in runs:
        good[run.start : run.start + lags] = False
    for k in range(1, lags + 1):
        good[k:] &= usable[:-k]
    return good.astype(float)


def estimate(residual: np.ndarray, usable: np.ndarray, runs: list[slice], spent: float) -> Whitener:
    """Autoregression of one joint's residual, its order by the Bayesian criterion.

    Args:
        residual: (M,) [Nm].
        usable: (M,) rows that count.
        spent: parameters that were fitted to these rows.
    """
    M = int(usable.sum())
    if M < 10:
        return Whitener(np.zeros(0), 1.0, np.zeros(len(residual)))
    white = Whitener(np.zeros(0), 1.0, usable.astype(float))
    full = weights(usable, runs, MOST_LAGS) > 0
    best = (np.inf, white)
    count = int(full.sum())
    if count < 20 * MOST_LAGS:
        sigma = float(np.sqrt(np.sum(residual[usable] ** 2) / max(M - spent, 1)))
        return Whitener(np.zeros(0), max(sigma, 1e-12), usable.astype(float))
    at = np.flatnonzero(full)
    past = np.stack([residual[at - k] for k in range(1, MOST_LAGS + 1)], axis=1)
    now = residual[at]
    for p in range(MOST_LAGS + 1):
        lags = np.linalg.lstsq(past[:, :p], now, rcond=None)[0] if p else np.zeros(0)
        left = now - past[:, :p] @ lags
        variance = float(left @ left) / count
        score = count * np.log(max(variance, 1e-300)) + 2 * p * np.log(count)
        if score < best[0]:
            sigma = np.sqrt(variance * count / max(count - p - min(spent, 0.8 * count), 1))
            best = (score, Whitener(_stable(lags), max(float(sigma), 1e-12), weights(usable, runs, p)))
    return best[1]


def _stable(lags: np.ndarray) -> np.ndarray:
    """Roots pulled inside the unit circle."""
    if not len(lags):
        return lags
    largest = np.abs(np.roots([1.0, *-lags])).max()
    if largest < 0.98:
        return lags
    return lags * (0.98 / largest) ** np.arange(1, len(lags) + 1)
