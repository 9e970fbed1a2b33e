"""Does the log run the same trajectory again? Then what differs from one run to the other is noise.

Whatever a model leaves out comes back the second time, and cancels; so the noise is known without knowing the physics.
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.models.dynamic.samples import Samples
from app.diagnosis.thresholds.repeats import CHANGED, LEAST, SAME, SHORTEST

STRETCHES = 20  # of the rows that have a partner


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


def noise_of_repeats(samples: Samples, left: np.ndarray) -> np.ndarray | None:
    """(n,) noise of each joint's torque [Nm] from what differs between two runs of one trajectory; None without such.

    Where the second run is not as the first by what the model does not know either, the half of its stretches that
    differ least tells it.

    Args:
        left: (M, n) [Nm] what the model leaves: a load that it knows to have been taken up in between is no noise.
    """
    lag = repeat_of(samples.state.q, [slice(0, len(left))])
    if not lag:
        return None
    differs = (left[lag:] - left[:-lag]) / np.sqrt(2.0)
    plain = np.std(differs, axis=0)
    edges = np.linspace(0, len(differs), STRETCHES + 1).astype(int)[:-1]
    each = (
        np.add.reduceat((differs - differs.mean(axis=0)) ** 2, edges)
        / np.diff([*edges, len(differs)])[:, None]
    )
    robust = np.sqrt(
        np.median(each, axis=0)
    )  # by stretches: a torque in coarse digits hardly ever differs row by row
    return np.where(plain > CHANGED * robust, robust, plain)
