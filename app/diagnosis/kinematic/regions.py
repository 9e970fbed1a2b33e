"""Whether mechanisms and what has no name say anything of poses elsewhere, by leaving whole regions out."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic.description import Description
from app.diagnosis.regression.heldout import heldout_residuals

#: Halvings of the poses: eight regions.
_HALVINGS = 3


def regions(q: np.ndarray) -> np.ndarray:
    """(m,) region of each pose q (m, n): halved across the direction in which they spread most, again and again."""
    scale = q.std(axis=0)
    z = (q - q.mean(axis=0)) / np.where(scale > 0, scale, 1.0)
    out = np.zeros(len(q), int)
    for _ in range(_HALVINGS):
        halves = out * 2
        for region in np.unique(out):
            inside = np.flatnonzero(out == region)
            own = z[inside] - z[inside].mean(axis=0)
            along = own @ np.linalg.svd(own, full_matrices=False)[2][0]
            halves[inside] += along > np.median(along)
        out = halves
    return out


def local(found: Description, kept: np.ndarray) -> bool:
    """True where a region is predicted better by calibration alone than with all that was found, learnt elsewhere.

    Args:
        kept: (m,) False for rows that are set aside.
    """
    linear, of, precision = found.linear, found.library.fixed, found.precisions()
    lower = [n for n in precision if of[n].effect.level == Level.CALIBRATION]
    upper = [n for n in precision if of[n].effect.level != Level.CALIBRATION]
    if not lower or not upper:
        return False
    blocks = [linear.raw(of[n]) for n in (*lower, *upper)]
    prior = [np.full(b.shape[1], precision[n]) for b, n in zip(blocks, (*lower, *upper), strict=True)]
    columns = np.hstack([linear.free, *blocks])
    free, values = linear.free.shape[1], linear.state.weights.shape[1]
    calibrated = free + sum(len(p) for p in prior[: len(lower)])
    few, every = heldout_residuals(
        columns, found.response(), np.concatenate([np.zeros(free), *prior]),
        np.repeat(regions(found.state.recording.q), values), [calibrated, columns.shape[1]], linear.absorbed,
    )  # fmt: skip
    counted = np.repeat(kept, values) & np.isfinite(few) & np.isfinite(every)
    return bool(np.sum(every[counted] ** 2) > np.sum(few[counted] ** 2))
