"""How large whatever an arm is off by is expected to be, before anything is measured."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from app.diagnosis.thresholds.evidence import LIKENESS


def density(widths: np.ndarray, noise: float | None, others: Collection[float]) -> np.ndarray | None:
    """(w,) log density of each width: near the nominal size, and near the widths that it is alike with.

    Args:
        widths: (w,) as variances, in units of the variance of the noise.
        noise: that variance, as a nominal size is 1; None where one width is as likely as another.
        others: widths of what it is alike with.

    Returns:
        None where nothing is expected.
    """
    if noise is None and not others:
        return None
    logs = np.log(widths)
    out = np.zeros(len(logs))
    if noise is not None:
        out -= 0.5 * ((logs + np.log(noise)) / LIKENESS) ** 2
    if others:
        out -= 0.5 * ((logs - np.log(list(others)).mean()) / LIKENESS) ** 2
    return out
