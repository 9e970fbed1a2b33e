"""Axis 1 and axis 2 parallel: no common perpendicular has a place."""

from __future__ import annotations

import math

from app.calibration.base.checks import Check
from app.calibration.result import Warning_
from app.errors import DegenerateGeometryError
from app.units import deg, from_deg

LEAST = from_deg(10)


def _parallel(sine: float) -> tuple[Warning_, ...]:
    if sine < math.sin(LEAST):
        raise DegenerateGeometryError(
            f"axis 1 and axis 2 are parallel (to {deg(math.asin(min(sine, 1.0))):.3f} degrees), as on a SCARA arm: "
            f"their common perpendicular has no place, so this procedure has no origin to offer",
            rank=1,
            needed=2,
            code=CHECK.key,
            advice="use a procedure with known points, or turn an axis that crosses axis 1",
        )
    return ()


CHECK = Check("parallel", "axis 1 and axis 2 parallel", {"parallel": _parallel})
