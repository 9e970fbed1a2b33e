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

import numpy as np
from scipy.ndimage import correlate1d

from app.diagnosis.models.dynamic.spline import spline
from app.diagnosis.wording import note, smoothing_source

DEGREE = 4
HALF_WIDTHS = (2, 3, 4, 6, 8, 11, 15, 20, 27, 36, 48)
_SIXTH = np.array([1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0])
_PROBE = 20_000  # samples the choice of the window looks at
_QUIET = 0.98  # share of the sixth differences that are noise; reversals and start-ups are not
_QUIET_VARIANCE = 0.8735  # of a unit normal cut off at that share: 1 - 2 c phi(c) / 0.98 with c = 2.326
_BEFORE = 2  # so many windows narrower, a window's bias is nearly all gone
_JITTER = 0.5  # of a step: samples nearer than this to the ticks of an even clock belong to them
_TOGETHER = 100_000  # samples of several joints that are brought back to their times at once
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


@dataclass(frozen=True)
class Windows:
    """What a signal itself asks for, joint by joint.

    Args:
        position, speed: half widths for the position, and for speed and acceleration.
        noise: of the signal that is differentiated.
        risks: mean square error left on the acceleration.
        source: that signal.
    """

    position: tuple[int, ...]
    speed: tuple[int, ...]
    noise: tuple[float, ...]
    risks: tuple[float, ...]
    source: str

    def smoothing(self, step: float, half_width: int | None) -> Smoothing:
        widths = self.speed if half_width is None else (half_width,) * len(self.speed)
        return Smoothing(widths, self.noise, step, self.source, tuple(float(np.sqrt(r)) for r in self.risks))


class Run:
    """A run without a gap on its even clock, from which its motion comes under any window.

    Args:
        t: (m,) [s], rising.
        q: (m, n) [rad or m].
        qd: (m, n) recorded speed, or None.
        step: the usual sampling step [s].
    """

    def __init__(self, t: np.ndarray, q: np.ndarray, qd: np.ndarray | None, step: float):
        self.t, self.step = t, step
        self.even_q, self.own = _even(t, q, step)
        self.even_qd = None if qd is None else _even(t, qd, step)[0]
        self.grid = _grid(t, step)[0]
        self._position: np.ndarray | None = None

    def windows(self) -> Windows:
        """The windows of least risk."""
        n, own = self.even_q.shape[1], self.own
        widths, risks = zip(*(choose_half_width(self.even_q[:, j], own, 2) for j in range(n)), strict=True)
        if self.even_qd is None:
            noise = tuple(noise_of(self.even_q[:, j]) for j in range(n))
            return Windows(widths, widths, noise, risks, "position")
        speed, risks = zip(*(choose_half_width(self.even_qd[:, j], own, 1) for j in range(n)), strict=True)
        noise = tuple(noise_of(self.even_qd[:, j]) for j in range(n))
        return Windows(widths, speed, noise, risks, "recorded speed")

    def motion(
        self, windows: Windows, half_width: int | None = None
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Smoothed position, speed and acceleration (m, n) each, at the sample times."""
        if self._position is None:
            self._position = self._derived(self.even_q, windows.position, 0)
        widths = windows.speed if half_width is None else (half_width,) * len(windows.speed)
        of, first = (self.even_q, 1) if self.even_qd is None else (self.even_qd, 0)
        return self._position, self._derived(of, widths, first), self._derived(of, widths, first + 1)

    def _derived(self, even: np.ndarray, widths: tuple[int, ...], derivative: int) -> np.ndarray:
        """(m, n) a derivative of the signal at the sample times."""
        out = np.empty((len(self.t), even.shape[1]))
        at = np.clip(self.t, self.grid[0], self.grid[-1])
        together = max(1, _TOGETHER // len(self.grid))
        for first in range(0, even.shape[1], together):
            part = range(first, min(first + together, even.shape[1]))
            columns = np.stack([_filter(even[:, j], widths[j], derivative, self.own) for j in part], axis=1)
            out[:, part] = columns if self.grid is self.t else spline(self.grid, columns, at)
        return out


def differentiate(
    t: np.ndarray,
    q: np.ndarray,
    qd: np.ndarray | None,
    segments: list[slice],
    step: float,
    half_width: int | None = None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray, Smoothing]:
    """Smoothed position, speed and acceleration at the sample times.

    Args:
        t: (m,) [s], rising inside each segment.
        q: (m, n) [rad or m].
        qd: (m, n) recorded speed, or None.
        segments: runs without a gap.
        step: the usual sampling step [s].
        half_width: of the window of speed and acceleration, for all joints; None chooses each by risk.

    Returns:
        q, qd, qdd: (m, n) each, and what was used.
    """
    runs = sorted(segments, key=lambda s: s.start - s.stop)  # the longest tells the windows
    windows: Windows | None = None
    out = tuple(np.empty_like(q) for _ in range(3))
    for part in runs:
        run = Run(t[part], q[part], None if qd is None else qd[part], step)
        windows = run.windows() if windows is None else windows
        for to, values in zip(out, run.motion(windows, half_width), strict=True):
            to[part] = values
    assert windows is not None
    return out[0], out[1], out[2], windows.smoothing(step, half_width)


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
        return spline(t, values, grid), own
    late = (t - grid)[:, None]
    out = values
    for _ in range(3):  # the slope is taken from what was moved already
        slope, bend = (
            np.stack([_filter(column, _ALONG, d, own) for column in out.T], axis=1) for d in (1, 2)
        )
        out = values - late * slope - 0.5 * late**2 * bend
    return out, own


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
