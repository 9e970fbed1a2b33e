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
    contradiction = "axis 2 turns about -Y of the frame found, where positive motion turns about +Y"
    if swapped_likely(base):
        yield Warning_(
            "swapped",
            f"the rows of axis 1 and axis 2 seem to be swapped: {contradiction}, and the circle called axis 2 lies "
            f"as axis 1's should",
            "interchange the axis numbers; else check the direction of both arcs",
            severe=True,
        )
        return
    yield Warning_(
        CHECK.key,
        f"{contradiction}: one arc was recorded in the wrong direction, the rows of axis 1 and axis 2 are swapped, or "
        f"the point in front of the robot is behind it",
        "check the order of rows or angle_deg, axis1_sense and axis2_sense, towards_workspace_mm",
        severe=True,
    )


CHECK = Check("direction", "directions that contradict each other", {"frame": _frame})
