"""A clock that was set back in the middle of a log, or that starts again with every run."""

from __future__ import annotations

import numpy as np

from app.diagnosis.thresholds.rows import FEWEST, GAP


def going_on(t: np.ndarray) -> tuple[np.ndarray, int]:
    """Times that rise where a clock was set back, and how often it was.

    Before and after such a step the clock runs evenly for `FEWEST` rows at least; what was recorded after it is put
    behind what was recorded before it, with a gap between the two, for nobody says how long it was. Single times that
    are wrong are left alone.

    Args:
        t: (m,) [s], as recorded; may hold NaN.
    """
    known = np.flatnonzero(np.isfinite(t))
    steps = np.diff(t[known])
    back = np.flatnonzero(steps < 0) + 1
    ends = np.concatenate([[0], back, [len(known)]])
    if not len(back) or np.diff(ends).min() < FEWEST:
        return t, 0
    usual = float(np.median(steps))
    for k in back.tolist():
        around = np.concatenate([steps[max(k - FEWEST, 0) : k - 1], steps[k : k + FEWEST - 1]])
        if np.any(around > GAP * usual):
            return t, 0
    gap = (GAP + 1.0) * usual
    out = t.copy()
    for k in back.tolist():
        out[known[k] :] += out[known[k - 1]] - out[known[k]] + gap
    return out, len(back)
