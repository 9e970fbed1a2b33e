"""Speed and acceleration from sampled positions by zero-phase local polynomials.

A polynomial of degree 4 is fitted to a window centred on each sample (Savitzky, Golay 1964), so nothing is
delayed. The window is chosen by unbiased risk (Stein 1981): the noise is known from sixth differences, what
a wider window saves in noise and costs in bias is then estimated from the data alone.

Samples that jitter about an even clock are moved onto it along the smoothed signal. Interpolated, their noise
would be averaged away in some places and not in others, and the window chosen by a noise that is not there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import correlate1d

from app.diagnosis.wording import note, smoothing_source

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

DEGREE = 4
HALF_WIDTHS = (2, 3, 4, 6, 8, 11, 15, 20, 27, 36, 48)
_SIXTH = np.array([1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0])
_PROBE = 20_000  # samples the choice of the window looks at
_QUIET = 0.98  # share of the sixth differences that are noise; reversals and start-ups are not
_QUIET_VARIANCE = 0.8735  # of a unit normal cut off at that share: 1 - 2 c phi(c) / 0.98 with c = 2.326
_BEFORE = 2  # so many windows narrower, a window's bias is nearly all gone
_JITTER = 0.5  # of a step: samples nearer than this to the ticks of an even clock belong to them
_ALONG = 6  # half width of the window along which they are moved


@dataclass(frozen=True)
class Smoothing:
    """What was used.

    Args:
        half_widths: of the window in samples, one a joint.
        noise: of the signal.
        step: [s].
        acceleration: error left on the acceleration, noise and bias [rad/s^2], one a joint.
    """

    half_widths: tuple[int, ...]
    noise: tuple[float, ...]
    step: float
    source: str
    acceleration: tuple[float, ...] = ()

    def sentence(self) -> str:
        low, high = min(self.half_widths), max(self.half_widths)
        return note(
            "smoothing" if low == high else "smoothing_widths",
            source=smoothing_source(self.source),
            degree=DEGREE,
            low=2 * low + 1,
            high=2 * high + 1,
            seconds=(2 * high + 1) * self.step,
        )


def noise_of(signal: np.ndarray) -> float:
    """One-sigma white noise of a smooth sampled signal, from its sixth differences; (m,) -> scalar."""
    if len(signal) < 16:
        return 0.0
    d = np.convolve(signal, _SIXTH, mode="valid") / np.linalg.norm(_SIXTH)
    kept = d[np.abs(d) <= np.quantile(np.abs(d), _QUIET)]
    return float(np.sqrt(np.mean(kept**2) / _QUIET_VARIANCE)) if len(kept) else 0.0


def choose_half_width(signal: np.ndarray, step: float, derivative: int) -> tuple[int, float]:
    """The window with the smallest estimated risk of the `derivative`-th derivative, and that risk; signal (m,)."""
    probe = signal[:_PROBE]
    sigma = noise_of(probe)
    widths = [h for h in HALF_WIDTHS if 2 * h + 1 <= len(probe) // 2]
    if not widths:
        return 2, 0.0
    edge = HALF_WIDTHS[-1] if len(probe) > 4 * HALF_WIDTHS[-1] else widths[-1]
    inner = slice(edge, -edge)
    made: list[tuple[np.ndarray, np.ndarray]] = []
    risks = []
    for k, h in enumerate(widths):
        c = _weights(h, derivative)[h] / step**derivative
        made.append((correlate1d(probe, c)[inner], c))
        bias = 0.0
        if k:
            before, narrow = made[max(k - _BEFORE, 0)]
            pad = np.zeros_like(c)
            middle = len(c) // 2 - len(narrow) // 2
            pad[middle : middle + len(narrow)] = narrow
            bias = np.mean((made[k][0] - before) ** 2) - sigma**2 * np.sum((c - pad) ** 2)
        risks.append(max(bias, 0.0) + sigma**2 * np.sum(c**2))
    best = int(np.argmin(risks))
    return widths[best], float(risks[best])


@lru_cache(maxsize=128)
def _weights(half: int, derivative: int) -> np.ndarray:
    """(2 half + 1, 2 half + 1): what each sample of a window adds to the polynomial's derivative at each place.

    The middle row is the filter; the others serve the ends of a log. For a step of one.
    """
    x = np.arange(-half, half + 1) / half  # powers of whole samples would be far apart in size
    fitted = np.linalg.pinv(np.vander(x, DEGREE + 1, increasing=True))
    powers = np.arange(derivative, DEGREE + 1)
    factor = np.array([math.perm(int(p), derivative) for p in powers], float)
    at = factor * x[:, None] ** (powers - derivative) / half**derivative
    out = at @ fitted[derivative:]
    # To the last digit, so that the filter below may add before it multiplies.
    out[half] = 0.5 * (out[half] + (-1) ** derivative * out[half][::-1])
    return out


def differentiate(
    t: np.ndarray, q: np.ndarray, qd: np.ndarray | None, segments: list[slice], step: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, Smoothing]:
    """Smoothed position, speed and acceleration at the sample times.

    Args:
        t: (m,) [s], rising inside each segment.
        q: (m, n) [rad or m].
        qd: (m, n) recorded speed, or None.
        segments: runs without a gap.
        step: the usual sampling step [s].

    Returns:
        q, qd, qdd: (m, n) each, and what was used.
    """
    longest = max(segments, key=lambda s: s.stop - s.start)
    even_q, own = _even(t[longest], q[longest], step)
    n = q.shape[1]
    widths, risks = zip(*(choose_half_width(even_q[:, j], own, 2) for j in range(n)), strict=True)
    noise = [noise_of(even_q[:, j]) for j in range(n)]
    source, widths_qd, noise_qd = "position", widths, noise
    if qd is not None:
        even_qd, own = _even(t[longest], qd[longest], step)
        widths_qd, risks = zip(*(choose_half_width(even_qd[:, j], own, 1) for j in range(n)), strict=True)
        noise_qd = [noise_of(even_qd[:, j]) for j in range(n)]
        source = "recorded speed"
    out_q, out_qd, out_qdd = np.empty_like(q), np.empty_like(q), np.empty_like(q)
    for part in segments:
        tt = t[part]
        grid_q, own = _even(tt, q[part], step)
        grid_qd = None if qd is None else _even(tt, qd[part], step)[0]
        back = _back(tt, step)
        for j in range(n):
            smooth_q = _filter(grid_q[:, j], widths[j], 0, own)
            if grid_qd is None:
                speed = _filter(grid_q[:, j], widths[j], 1, own)
                acceleration = _filter(grid_q[:, j], widths[j], 2, own)
            else:
                speed = _filter(grid_qd[:, j], widths_qd[j], 0, own)
                acceleration = _filter(grid_qd[:, j], widths_qd[j], 1, own)
            out_q[part, j], out_qd[part, j], out_qdd[part, j] = (
                back(smooth_q),
                back(speed),
                back(acceleration),
            )
    if qd is not None:
        widths, noise = widths_qd, noise_qd
    left = tuple(float(np.sqrt(r)) for r in risks)
    return out_q, out_qd, out_qdd, Smoothing(tuple(widths), tuple(noise), step, source, left)


def _is_even(t: np.ndarray, step: float) -> bool:
    return (
        bool(np.all(np.abs(np.diff(t) - step) < 0.02 * step))
        and abs((t[-1] - t[0]) - (len(t) - 1) * step) < 0.5 * step
    )


def _grid(t: np.ndarray, step: float) -> tuple[np.ndarray, float, bool]:
    """The even clock of some samples, its step, and whether every tick is one sample's."""
    if len(t) < 4 or _is_even(t, step):
        return t, step, True
    own = float(t[-1] - t[0]) / (len(t) - 1)
    ticks = own * np.arange(len(t))
    ticks += np.mean(t - ticks)
    if np.max(np.abs(t - ticks)) < _JITTER * own:
        return ticks, own, True
    return t[0] + step * np.arange(int((t[-1] - t[0]) / step) + 1), step, False


def _even(t: np.ndarray, values: np.ndarray, step: float) -> tuple[np.ndarray, float]:
    """Values (m, n) on an even clock, and its step; untouched where they are even already."""
    grid, own, each = _grid(t, step)
    if grid is t:
        return values, own
    if not each or len(t) < 4 * _ALONG:
        return np.asarray(_spline(t, values)(grid)), own
    late = (t - grid)[:, None]
    out = values
    for _ in range(3):  # the slope is taken from what was moved already
        slope, bend = (
            np.stack([_filter(column, _ALONG, d, own) for column in out.T], axis=1) for d in (1, 2)
        )
        out = values - late * slope - 0.5 * late**2 * bend
    return out, own


def _back(t: np.ndarray, step: float):
    """From the even clock to the sample times."""
    grid, _, _ = _grid(t, step)
    if grid is t:
        return lambda values: values
    return lambda values: _spline(grid, values)(np.clip(t, grid[0], grid[-1]))


def _spline(t: np.ndarray, values: np.ndarray) -> CubicSpline:
    from scipy.interpolate import CubicSpline  # slow to load, and most logs are even

    return CubicSpline(t, values, axis=0)


def _filter(signal: np.ndarray, half: int, derivative: int, step: float) -> np.ndarray:
    width = 2 * half + 1
    if len(signal) < width:
        width = len(signal) - 1 + len(signal) % 2
    if width <= DEGREE:
        for _ in range(derivative):
            signal = np.gradient(signal, step) if len(signal) > 1 else np.zeros_like(signal)
        return signal
    half = width // 2
    weights = _weights(half, derivative) / step**derivative
    out = correlate1d(signal, weights[half])
    out[:half] = weights[:half] @ signal[:width]
    out[-half:] = weights[-half:] @ signal[-width:]
    return out
