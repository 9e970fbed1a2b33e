"""Noise of each joint's torque: its size and how it hangs together in time (autoregression).

The noise is learnt from what a fit with very many columns leaves. Such a fit takes the slow part of the noise away
with it: white noise then seems to swing from one row to the next, and a filter made for that would later call
slow noise physics. What the fit took, lag by lag, is put back before the autoregression is made.

Source: Worsley et al. (2002), A general statistical analysis for fMRI data, bias of autocorrelations.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

MOST_LAGS = 6
REACH = 12  # lags after which noise is taken to have forgotten itself
LEAST_SHARE = 0.1  # of the noise's variance, a fit leaves at least
WHITE = 0.3  # one-sigma of a correlation from one row to another, before the log is looked at


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


def estimate(residual: np.ndarray, usable: np.ndarray, runs: list[slice], taken: np.ndarray) -> Whitener:
    """Autoregression of one joint's noise, its order by the Bayesian criterion.

    Args:
        residual: (M,) [Nm] what a fit left.
        usable: (M,) rows that count.
        taken: (M, d) directions whose products, row by row, stand for the fit's hat matrix; see noise.py.
    """
    M = int(usable.sum())
    if M < 10:
        return Whitener(np.zeros(0), 1.0, np.zeros(len(residual)))
    raw = lagged(residual[:, None], usable, runs, REACH)
    hat = lagged(taken, usable, runs, 2 * REACH)
    memory = _put_back(raw, hat, M)
    count = int(np.count_nonzero(weights(usable, runs, MOST_LAGS)))
    if count < 20 * MOST_LAGS:
        return Whitener(np.zeros(0), max(float(np.sqrt(memory[0])), 1e-12), usable.astype(float))
    best = (np.inf, np.zeros(0), memory[0])
    for lags, variance in _autoregressions(memory):
        score = count * np.log(max(variance, 1e-300)) + 2 * len(lags) * np.log(count)
        if score < best[0]:
            best = (score, lags, variance)
    sigma = max(float(np.sqrt(best[2])), 1e-12)
    return Whitener(_stable(best[1]), sigma, weights(usable, runs, len(best[1])))


def lagged(values: np.ndarray, usable: np.ndarray, runs: list[slice], reach: int) -> np.ndarray:
    """(reach + 1,) mean product of rows (M, d) with those so many later, over pairs that are usable and of one run."""
    run = np.zeros(len(usable), int)
    for i, part in enumerate(runs):
        run[part] = i
    values = np.where(usable[:, None], values, 0.0)
    out = np.zeros(reach + 1)
    for k in range(reach + 1):
        both = usable[k:] & usable[: len(usable) - k] & (run[k:] == run[: len(run) - k])
        products = np.einsum("ij,ij->i", values[k:], values[: len(values) - k])
        out[k] = products[both].sum() / max(np.count_nonzero(both), 1)
    return out


def _put_back(raw: np.ndarray, hat: np.ndarray, rows: int) -> np.ndarray:
    """(R + 1,) autocovariance of the noise from that of what was left (R + 1,), and the fit's mean products (2 R + 1,).

    Along time the fit is a filter: what is left of the noise's autocovariance is that convolved with 1 - hat. Slow
    noise it may take whole; there nothing can be known, and white noise is assumed (a Gaussian prior of WHITE).
    """
    left = -hat
    left[0] = max(1.0 - hat[0], LEAST_SHARE)
    k, m = np.arange(len(raw))[:, None], np.arange(len(raw))
    A = left[np.abs(k - m)] + np.where(m > 0, left[k + m], 0.0)
    size = raw[0] / left[0]
    if size <= 0.0:
        return raw
    believed = np.full(len(raw), 1.0 / (rows * WHITE**2))
    believed[0] = 0.0
    return np.linalg.solve(A.T @ A + np.diag(believed), A.T @ raw)


def _autoregressions(memory: np.ndarray) -> list[tuple[np.ndarray, float]]:
    """Lags and innovation variance of every order up to MOST_LAGS (Levinson, Durbin)."""
    lags, variance = np.zeros(0), float(memory[0])
    out: list[tuple[np.ndarray, float]] = [(lags, variance)]
    for p in range(1, MOST_LAGS + 1):
        reflection = (memory[p] - lags @ memory[p - 1 : 0 : -1]) / variance
        if not abs(reflection) < 1.0:
            break
        lags = np.append(lags - reflection * lags[::-1], reflection)
        variance *= 1.0 - reflection**2
        out.append((lags, variance))
    return out


def _stable(lags: np.ndarray) -> np.ndarray:
    """Roots pulled inside the unit circle."""
    if not len(lags):
        return lags
    largest = np.abs(np.roots([1.0, *-lags])).max()
    if largest < 0.98:
        return lags
    return lags * (0.98 / largest) ** np.arange(1, len(lags) + 1)
