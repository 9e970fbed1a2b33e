"""Axis 1 and axis 2 parallel: no common perpendicular has a place."""

from __future__ import annotations

import math

from app.calibration.base.checks import Check
from app.calibration.base.wording import degenerate
from app.calibration.result import Warning_
from app.units import deg, from_deg

LEAST = from_deg(10)


def _parallel(sine: float) -> tuple[Warning_, ...]:
    if sine < math.sin(LEAST):
        raise degenerate(CHECK.key, rank=1, needed=2, angle=deg(math.asin(min(sine, 1.0))))
    return ()


CHECK = Check("parallel", "axis 1 and axis 2 parallel", {"parallel": _parallel})
