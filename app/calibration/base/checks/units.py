"""Lengths in another unit than the file says: arcs no arm draws, or poses that fit a thousand times better in metres.

A reflector on an arm's flange goes round axis 1 or 2 at some centimetres to some metres. With poses the description
says how far apart the points must lie; the factor that makes them fit is named.
"""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import from_mm, mm

#: Radii [m] that a reflector on an arm can draw.
SMALLEST, LARGEST = from_mm(15.0), from_mm(30_000.0)


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if not SMALLEST <= found.radius <= LARGEST:
        yield remark(CHECK.key, "units_arc", severe=True, axis=found.arc.axis, radius=mm(found.radius))


def units_of_poses(factor: float, better: float) -> Warning_:
    """What is said where poses fit after all lengths were multiplied by `factor`, and how many times better."""
    return remark(CHECK.key, "units_poses", severe=True, factor=factor, better=better)


CHECK = Check("units", "lengths in another unit", {"arc": _arc})
