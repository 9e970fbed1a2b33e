"""Cubics between samples. Written out because loading scipy's interpolation takes as long as a short log."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_banded


def spline(t: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Values at times `at` (k,) of the cubic spline through values (m, n) at t (m,), rising; (k, n).

    At either end the first two pieces are one cubic. Source: de Boor, A Practical Guide to Splines (1978), ch. IV.
    """
    low = np.clip(np.searchsorted(t, at, side="right") - 1, 0, len(t) - 2)
    width = np.diff(t)
    slopes = _slopes(t, width, values) if len(t) >= 4 else np.gradient(values, t, axis=0)
    w = width[low, None]
    share = (at - t[low])[:, None] / w
    return hermite(values[low], values[low + 1], slopes[low] * w, slopes[low + 1] * w, share)


def _slopes(t: np.ndarray, width: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(m, n) slopes at the samples under which the curvature has no step."""
    w = width[:, None]
    chord = np.diff(values, axis=0) / w
    band, right = np.zeros((3, len(t))), np.empty_like(values)
    band[1, 1:-1] = 2.0 * (width[:-1] + width[1:])
    band[0, 2:], band[2, :-2] = width[:-1], width[1:]
    right[1:-1] = 3.0 * (w[1:] * chord[:-1] + w[:-1] * chord[1:])
    first, last = t[2] - t[0], t[-1] - t[-3]
    band[1, 0], band[0, 1] = width[1], first
    band[1, -1], band[2, -2] = width[-2], last
    right[0] = ((width[0] + 2.0 * first) * width[1] * chord[0] + width[0] ** 2 * chord[1]) / first
    right[-1] = (width[-1] ** 2 * chord[-2] + (2.0 * last + width[-1]) * width[-2] * chord[-1]) / last
    return solve_banded((1, 1), band, right, overwrite_ab=True, overwrite_b=True, check_finite=False)


def hermite(
    start: np.ndarray, end: np.ndarray, rise: np.ndarray, fall: np.ndarray, share: np.ndarray
) -> np.ndarray:
    """Hermite's cubic from `start` to `end` at `share` of the way, its slopes a whole width long."""
    chord = end - start
    bend = 3.0 * chord - 2.0 * rise - fall
    return start + share * (rise + share * (bend + share * (rise + fall - 2.0 * chord)))
