"""Does the log run the same trajectory again? Then what differs from one run to the other is noise.

Whatever a model leaves out comes back the second time, and cancels; so the noise is known without knowing the physics.
"""

from __future__ import annotations

import numpy as np

SAME = 0.01  # of each joint's own spread: so near the second run must follow the first
SHORTEST = 0.05  # of the log: less is no run
LEAST = 0.25  # of the log must have a partner


def repeat_of(q: np.ndarray, runs: list[slice]) -> int:
    """Windows from one run of a trajectory to the next of the same; 0 where there is none.

    Args:
        q: (M, n) positions at even steps.
        runs: slices without a gap; with more than one nothing is looked for.
    """
    count = len(q)
    spread = np.std(q, axis=0)
    moving = spread > 1e-3
    most, least = int((1 - LEAST) * count), max(int(SHORTEST * count), 8)
    if len(runs) != 1 or not moving.any() or most <= least:
        return 0
    x = (q[:, moving] - q[:, moving].mean(axis=0)) / spread[moving]
    size = 1 << (2 * count - 1).bit_length()
    spectrum = np.abs(np.fft.rfft(x, size, axis=0)) ** 2
    alike = np.fft.irfft(spectrum.mean(axis=1), size)[:count]
    power = np.concatenate([[0.0], np.cumsum(np.mean(x**2, axis=1))])
    lag = np.arange(count)
    # Mean square of x(t + lag) - x(t) over what overlaps.
    apart = (power[count] - power[lag] + power[count - lag] - 2 * alike) / (count - lag)
    best = least + int(np.argmin(apart[least:most]))
    within = float(np.max(apart[:best])) > 0.1  # in between the arm was elsewhere
    return best if within and apart[best] < SAME**2 else 0
