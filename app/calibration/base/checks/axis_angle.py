"""Axes 1 and 2 that are not square to each other, beyond what the measurement leaves open."""

from __future__ import annotations

import math
from collections.abc import Iterator

from app.calibration.base.checks import Check
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.estimation import HALF
from app.units import deg, from_deg

SIGMAS = 3.29  # 1 in 1000
_WORTH_NAMING = from_deg(0.001)


def _frame(base: BaseCalibration) -> Iterator[Warning_]:
    off = base.angle - math.pi / 2.0
    if abs(off) > max(SIGMAS * base.angle_sigma, _WORTH_NAMING):
        half = HALF * deg(base.angle_sigma)
        yield remark(CHECK.key, angle=deg(base.angle), off=abs(deg(off)), half=half)


CHECK = Check("axis_angle", "axes not square", {"frame": _frame})
