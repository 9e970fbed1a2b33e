"""What the written digits can do to the tool point.

A number written with a last digit of step h may be off by up to h/2 either way: a uniform error of standard deviation
h / sqrt(12). Each such error moves the tip, and the fit's gains carry the tip's error to the tool point.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.points import Points, Written
from app.calibration.result import ToolCalibration

#: Touches spread wider than this are believed, however coarse the digits [rad].
LARGEST_LEAST = 0.01


@dataclass(frozen=True, eq=False)
class Rounding:
    """Effect of rounding.

    Args:
        columns: names of the columns that contribute, the largest share first.
        covariance: (3, 3) of the tool point from rounding alone [m^2].
        touch: root mean square scatter of one tip on one axis from rounding alone [m].
    """

    columns: tuple[str, ...]
    covariance: np.ndarray
    touch: float

    @property
    def sigma_tool(self) -> np.ndarray:
        """(3,) standard deviation of the tool point along the flange's axes [m]."""
        return np.sqrt(np.diag(self.covariance))


def rounding(points: Points, result: ToolCalibration) -> Rounding:
    """Propagates the step of every column's last digit to the tool point."""
    written = points.written
    role = "plane" if any("plane" in c.roles for c in points.captures) else "touch"
    rows = [i for i, c in enumerate(points.captures) if role in c.roles]
    if len(rows) != len(result.gains):  # a mode that the touches have no part in
        return Rounding((), np.zeros((3, 3)), 0.0)
    values = written.values[rows]
    shares = np.zeros((len(written.steps), 3, 3))
    touch = 0.0
    for k, step in enumerate(written.steps):
        if step == 0.0:
            continue
        shift = np.zeros(len(written.steps))
        shift[k] = step / 2.0
        change = tips(written, values + shift, result) - tips(
            written, values - shift, result
        )  # (n, 3) over one step
        change /= np.sqrt(12.0)
        moved = np.einsum("nij,nj->ni", result.gains, change)
        shares[k] = moved.T @ moved
        touch += float(np.mean(change**2))
    order = np.argsort(-np.trace(shares, axis1=1, axis2=2))
    names = tuple(written.names[k] for k in order if np.trace(shares[k]) > 0.0)
    return Rounding(names, shares.sum(axis=0), float(np.sqrt(touch)))


def tips(written: Written, values: np.ndarray, result: ToolCalibration) -> np.ndarray:
    """(n, 3) where the found tool's tip would be for these numbers [m]."""
    poses = written.poses(values)
    return poses[:, :3, :3] @ result.tool_point + poses[:, :3, 3]


def least_turn(points: Points) -> float:
    """Angular spread [rad] of touches that rounding alone can produce: below it a turn cannot be told from none."""
    written = points.written
    rows = [i for i, c in enumerate(points.captures) if "touch" in c.roles]
    if not rows or not written.steps.any():
        return 0.0
    values = written.values[rows]
    total = 0.0
    for k, step in enumerate(written.steps):
        if step == 0.0:
            continue
        shift = np.zeros(len(written.steps))
        shift[k] = step / 2.0
        change = written.poses(values + shift)[:, :3, :3] - written.poses(values - shift)[:, :3, :3]
        total += float(np.mean(np.sum(change**2, axis=(1, 2)))) / 3.0 / 12.0
    return min(2.0 * float(np.sqrt(total)), LARGEST_LEAST)
