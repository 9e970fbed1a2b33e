"""Measurements that belong to other moments than their stamps say, in a recording made in motion: by how much."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from scipy.optimize import minimize_scalar

from app.diagnosis.models.kinematic.in_motion import in_bursts
from app.diagnosis.thresholds.conventions import DELAY_STEP, DELAY_SURE, MOST_APART


def delays(
    time: np.ndarray, likelihood: Callable[[float, float], float]
) -> Iterator[tuple[float, float, float]]:
    """The likeliest delay by the stamps (m,) [s] as they are, and by an even course of them where they come in bursts.

    Args:
        likelihood: of the recording with a delay [s] undone, by an even course or not, base and tool fitted [nats].

    Yields:
        delay [s], 1 for an even course, else 0, and the delay's standard deviation [s].
    """
    for even in (0.0, 1.0) if in_bursts(time) else (0.0,):

        def cost(seconds: float, even: float = even) -> float:
            return -likelihood(seconds, even)

        tried = np.arange(-MOST_APART, MOST_APART + DELAY_STEP, DELAY_STEP)
        best = float(tried[int(np.argmin([cost(float(seconds)) for seconds in tried]))])
        around = (best - DELAY_STEP, best + DELAY_STEP)
        found = minimize_scalar(cost, bounds=around, method="bounded", options={"xatol": DELAY_SURE})
        at, step = float(found.x), DELAY_STEP / 10.0
        curvature = (cost(at - step) - 2.0 * float(found.fun) + cost(at + step)) / step**2
        yield at, even, float(curvature**-0.5) if curvature > 0 else MOST_APART
