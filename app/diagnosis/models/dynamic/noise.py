"""Noise of each joint's torque: white noise and a wandering part, an ARMA(1, 1) process, by Whittle's likelihood.

Two readings of a residual. *Above the band of the motion* no law of the arm leaves much: what is there is noise, and a
model of it predicts how much noise there is below. Only against that prediction is "nothing is left" tested. *Over all
frequencies* what a model does not explain counts as noise: evidence is then tempered where the model is not complete.

Source: Whittle (1953), Estimation and information in stationary time series; the likelihood of a periodogram.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import get_lapack_funcs
from scipy.special import gammaincc

from app.diagnosis.thresholds.noise import (
    BAND,
    BAND_ABOVE,
    BAND_ENERGY,
    BURST,
    HIGHEST,
    LEAST_SHARE,
    MOST_BURST,
)

(_TBTRS,) = get_lapack_funcs(("tbtrs",), dtype=np.float64)  # scipy.signal would take half a second to load
PIECES = 60  # of a log, in which bursts are looked for
_FADED = 1e-12  # of what came in
SKIPPED = 8  # rows after which a filter has forgotten where it began
_RHO = np.array([0.0, 0.1, 0.2, 0.35, 0.5, 0.6, 0.68, 0.74, 0.79, 0.83, 0.86, 0.89, 0.92, 0.95])
_THETA = np.array([0.0, 0.1, 0.2, 0.3, 0.4, 0.55, 0.7, 0.8, 0.88, 0.94])
_GRID = np.array([(rho, rho * share) for rho in _RHO for share in _THETA if rho or not share])


@dataclass(frozen=True)
class Whitener:
    """(1 - rho L) e = (1 - theta L) innovation; turns rows of one joint into rows of unit noise.

    Args:
        sigma: standard deviation of the innovation [Nm].
    """

    sigma: float
    rho: float = 0.0
    theta: float = 0.0

    def __call__(self, columns: np.ndarray) -> np.ndarray:
        """(M, k) or (M,) -> (M - SKIPPED, ...)."""
        if self.rho == self.theta:
            return columns[SKIPPED:] / self.sigma
        steps = columns / self.sigma
        steps[1:] -= (self.rho / self.sigma) * columns[:-1]
        if self.theta == 0.0 or not steps.size:
            return steps[SKIPPED:]
        # e[t] = theta e[t - 1] + steps[t]: a triangular system with one band
        band = np.ones((2, len(steps)))
        band[1] = -self.theta
        return _TBTRS(band, steps, uplo="L", overwrite_b=1)[0][SKIPPED:]

    @property
    def memory(self) -> int:
        """Rows after which what came in has faded to a rounding error."""
        if self.theta == 0.0 or self.rho == self.theta:
            return 1
        return 1 + int(np.ceil(np.log(_FADED) / np.log(self.theta)))

    @property
    def spread(self) -> float:
        """Standard deviation of the noise itself [Nm]."""
        return self.sigma * float(np.sqrt(1.0 + (self.rho - self.theta) ** 2 / max(1.0 - self.rho**2, 1e-6)))


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Periodogram of a residual.

    Args:
        count: of rows.
        power: (f,), those of the band of the motion scaled up for what was fitted there.
        angle: (f,) [rad a sample].
        low: (f,) True within the band of the motion.
        free: share of the band's frequencies that are free.
    """

    count: int
    power: np.ndarray
    angle: np.ndarray
    low: np.ndarray
    free: float


@lru_cache(maxsize=4)
def _shapes(count: int, frequencies: int) -> tuple[np.ndarray, np.ndarray]:
    """One over the noise's spectrum, and its logarithm, (g, f) each, for every process of the grid.

    The same for all residuals of so many rows: joints and rounds share them.
    """
    c = np.cos(2.0 * np.pi * np.arange(1, frequencies + 1) / count)
    rho, theta = _GRID[:, :1], _GRID[:, 1:]
    density = (1.0 + theta**2 - 2.0 * theta * c) / (1.0 + rho**2 - 2.0 * rho * c)
    return 1.0 / density, np.log(density)


def spectrum(residual: np.ndarray, step: float, band: float, fitted: float) -> Spectrum:
    """Periodogram of residual (M,); `fitted` parameters were taken from the band below `band` [Hz]."""
    count = len(residual)
    power = np.abs(np.fft.rfft(residual - residual.mean())) ** 2 / count
    frequency = np.fft.rfftfreq(count, step)
    used = (frequency > 0) & (frequency < HIGHEST / step)
    power, frequency = power[used], frequency[used]
    low = frequency <= band
    inside = max(int(low.sum()), 1)
    free = max(inside - fitted / 2.0, LEAST_SHARE * inside)
    power[low] *= inside / free
    return Spectrum(count, power, 2.0 * np.pi * frequency * step, low, free / inside)


def over_all(found: Spectrum) -> Whitener:
    """The process that explains the whole residual best, as loud as the residual is in the band of the motion.

    Where a model leaves structure in that band, the band is louder than the process: it counts as noise there.
    """
    best = _best(found, np.where(found.low, found.free, 1.0))
    if not found.low.any():
        return best
    c = np.cos(found.angle[found.low])
    density = (1 + best.theta**2 - 2 * best.theta * c) / (1 + best.rho**2 - 2 * best.rho * c)
    louder = float(np.mean(found.power[found.low] / density)) / best.sigma**2
    return Whitener(best.sigma * float(np.sqrt(max(louder, 1.0))), best.rho, best.theta)


def _best(found: Spectrum, weight: np.ndarray) -> Whitener:
    inverse, logs = _shapes(found.count, len(found.power))
    total = max(float(weight.sum()), 1.0)
    variance = np.maximum(inverse @ (found.power * weight) / total, 1e-300)
    score = total * np.log(variance) + logs @ weight
    # A process without memory unless it is plainly worse: two parameters cost their share (Schwarz).
    score[1:] += np.log(total)
    k = int(score.argmin())
    return Whitener(max(float(np.sqrt(variance[k])), 1e-12), float(_GRID[k, 0]), float(_GRID[k, 1]))


def excess(found: Spectrum) -> tuple[float, float]:
    """Is there more in the band of the motion than the noise above it predicts?

    Returns:
        p of so much power in the band under the processes that the frequencies above it allow, each by its likelihood,
        and the power over what they predict.
    """
    low, high = found.low.astype(float), (~found.low).astype(float)
    if high.sum() < 20 or not found.low.any():
        return 1.0, 1.0
    inverse, logs = _shapes(found.count, len(found.power))
    variance = np.maximum(inverse @ (found.power * high) / high.sum(), 1e-300)
    likelihood = -high.sum() * np.log(variance) - logs @ high
    weight = np.exp(likelihood - likelihood.max())
    weight /= weight.sum()
    power = inverse @ (found.power * low) / low.sum() / variance
    shape = max(float(low.sum()) * found.free, 1.0)
    p = float((weight * gammaincc(shape, power * shape)).sum())
    return p, float(1.0 / (weight / np.maximum(power, 1e-12)).sum())


def band_of(signals: np.ndarray, step: float) -> float:
    """Frequency [Hz] where the band of the motion ends; signals (M, s) are torques and speeds of the description."""
    centred = (signals - signals.mean(axis=0)) * np.hanning(len(signals))[:, None]
    energy = np.cumsum(np.abs(np.fft.rfft(centred, axis=0)) ** 2, axis=0)
    moving = energy[-1] > 1e-12
    if not moving.any():
        return BAND[0]
    share = energy[:, moving] / energy[-1, moving]
    frequency = np.fft.rfftfreq(len(signals), step)
    top = float(frequency[(share > BAND_ENERGY).argmax(axis=0)].max())
    return float(np.clip(BAND_ABOVE * top, BAND[0], max(BAND[1] / step, BAND[0])))


def without_bursts(residual: np.ndarray) -> np.ndarray:
    """(M,) residual in which short stretches far louder than the others are as loud as those in the middle.

    What happens once, a push or a load that is put down, is no noise of the whole log, however much it is; a residual
    that is loud for long is left as it is.
    """
    edges = np.linspace(0, len(residual), PIECES + 1).astype(int)
    length = np.maximum(np.diff(edges), 1)
    if len(residual) < 2 * PIECES:
        return residual
    loud = np.sqrt(np.add.reduceat(residual**2, edges[:-1]) / length)
    middle = float(np.median(loud))
    burst = loud > BURST * middle
    if burst.mean() > MOST_BURST:
        return residual
    return residual * np.repeat(np.where(burst, middle / np.maximum(loud, 1e-300), 1.0), length)


def without_spikes(residual: np.ndarray) -> np.ndarray:
    """(M,) residual in which single values above their running median are drawn in; runs of them are structure.

    Beyond 4.5 robust standard deviations from the median a value is replaced by it, beyond 3.5 it is cut there.
    """
    from scipy.ndimage import median_filter

    middle = median_filter(residual, 9, mode="nearest")
    off = residual - middle
    spread = 1.4826 * float(np.median(np.abs(off))) + 1e-12
    return middle + np.where(np.abs(off) > 4.5 * spread, 0.0, np.clip(off, -3.5 * spread, 3.5 * spread))
