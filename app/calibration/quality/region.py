"""The region that holds the true tool point in 95 of 100 cases.

The noise is estimated from few touches, so chi-squared would promise too much: with three touches there are three
degrees of freedom, and the region reaches 5.3 standard errors, not 2.8.

    (t - t0)^T C^-1 (t - t0) / 3  ~  F(3, dof)        C = sigma^2 (…)^-1, sigma^2 = SSE / dof

Source: Seber and Lee (2003), Linear Regression Analysis, section 5.1; Hotelling (1931).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.result import ToolCalibration
from app.estimation import LEVEL, reach


@dataclass(frozen=True, eq=False)
class Ellipsoid:
    """A region around the tool point, in the flange.

    Args:
        centre: (3,) [m].
        semi_axes: (3,) half lengths, longest first [m].
        directions: (3, 3) one a column, right-handed, in the order of `semi_axes`.
        level: how often it holds the true point.
    """

    centre: np.ndarray
    semi_axes: np.ndarray
    directions: np.ndarray
    level: float

    def holds(self, point: np.ndarray) -> bool:
        """True where `point` (3,) [m] lies inside."""
        local = self.directions.T @ (np.asarray(point, float) - self.centre)
        return bool(np.sum((local / self.semi_axes) ** 2) <= 1.0)


def ellipsoid(result: ToolCalibration, level: float = LEVEL) -> Ellipsoid:
    """The region of the whole tool point."""
    values, vectors = np.linalg.eigh(result.covariance)
    order = np.argsort(values)[::-1]
    vectors = vectors[:, order]
    if np.linalg.det(vectors) < 0:
        vectors[:, 2] = -vectors[:, 2]
    lengths = np.sqrt(np.maximum(values[order], 1e-30)) * reach(result.dof, level)
    return Ellipsoid(result.tool_point, lengths, vectors, level)


def half_widths(result: ToolCalibration, level: float = LEVEL) -> np.ndarray:
    """(3,) half width of the interval of each flange axis taken alone [m]."""
    return result.sigma_tool * reach(result.dof, level, 1)
