"""Z, X and the turn of axis 2 contradict each other: rows swapped, or an arc recorded backwards.

Positive motion turns axis 2 about +Y. If Y = Z x X comes out on the other side, one of three things happened: the
rows of the two axes are interchanged, the direction of one arc is wrong, or the point in front of the robot is
behind it. Swapped rows are told by the arm's plane: the circle of axis 2 lies near a plane that holds axis 1,
while the circle of axis 1 usually does not lie at the height of axis 2; and by a levelled tracker.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from app.calibration.base.checks import Check
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import from_deg

_UPRIGHT, _LYING = math.cos(from_deg(10)), math.sin(from_deg(10))


def swapped_likely(base: BaseCalibration) -> bool:
    """True where the arcs look better with their axis numbers interchanged."""
    d1, d2 = base.first.axes.direction, base.second.axes.direction
    if abs(d2[2]) > _UPRIGHT and abs(d1[2]) < _LYING:
        return True
    if abs(d1[2]) > _UPRIGHT and abs(d2[2]) < _LYING:
        return False
    origin = base.T_tracker_base.position
    height = abs(float((base.first.centre - origin) @ d1))
    aside = abs(float((base.second.centre - origin) @ d2))
    return bool(height < 0.5 * aside)


def _frame(base: BaseCalibration) -> Iterator[Warning_]:
    if base.axis2_along_y > 0 or not np.isfinite(base.axis2_along_y):
        return
    yield remark("swapped" if swapped_likely(base) else CHECK.key, severe=True)


CHECK = Check("direction", "directions that contradict each other", {"frame": _frame})
