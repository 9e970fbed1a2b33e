"""Many cells at once: the same fit and the same frame as for one, without the checks.

For studies of a procedure (how much arc, how many points, which tracker) before anybody turns an axis.
"""

from __future__ import annotations

import numpy as np

from app.calibration.base.frame import Axes, BaseFrames, base_frames
from app.calibration.base.sense import wrapped
from app.geometry.circle import fit_axis

_CHUNK = 512  # cells in one sweep: what the processor's cache holds
_UNCLEAR_SHARE = 0.02  # of the radius, as for one cell


def solve_cells(
    first: np.ndarray,
    second: np.ndarray,
    sigma_first: np.ndarray | float,
    sigma_second: np.ndarray | float,
    towards: np.ndarray | None = None,
) -> BaseFrames:
    """Base frames of m cells, rows in the order of positive motion.

    Args:
        first, second: (m, n, 3) [m] arcs of axis 1 and axis 2; the two may differ in n.
        sigma_first, sigma_second: one-sigma noise of a coordinate [m], broadcast to (m, n).
        towards: (m, 3) [m] in front of each robot; default the middle of its arc of axis 1.

    Returns:
        BaseFrames of m cells.
    """
    m = len(first)
    sigma_first = np.broadcast_to(sigma_first, first.shape[:2])
    sigma_second = np.broadcast_to(sigma_second, second.shape[:2])
    parts = []
    for start in range(0, m, _CHUNK):
        now = slice(start, start + _CHUNK)
        one, radius = _axes(first[now], sigma_first[now])
        two, _ = _axes(second[now], sigma_second[now])
        front = first[now].mean(axis=1) if towards is None else towards[now]
        unclear = _UNCLEAR_SHARE * radius if towards is None else 1e-3
        parts.append(base_frames(one, two, front, unclear=unclear))
    names = BaseFrames.__dataclass_fields__
    return BaseFrames(*(np.concatenate([getattr(p, name) for p in parts]) for name in names))


def _axes(points: np.ndarray, sigma: np.ndarray) -> tuple[Axes, np.ndarray]:
    fit = fit_axis(points, 1.0 / sigma**2)
    steps = wrapped(np.diff(fit.azimuths, axis=-1))
    backwards = np.sign(steps).sum(axis=-1) < 0
    axes = Axes(fit.point, fit.basis, fit.covariance[..., :4, :4])
    return axes.reversed_where(backwards), fit.radii[..., 0]
