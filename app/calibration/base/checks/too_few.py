"""Too few points for a circle, or too few to judge one."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.arcs import Arc
from app.calibration.base.checks import Check
from app.calibration.result import Warning_
from app.errors import DegenerateGeometryError, TooFewPointsError
from app.units import from_um, mm

NEEDED = 3
COMFORTABLE = 6
_LINE = 1e-4  # second over first extent of the points below which they lie on one line
_PLACE = from_um(1)


def _points(arc: Arc) -> tuple[Warning_, ...]:
    for reflector in np.unique(arc.reflectors):
        mine = arc.points[arc.reflectors == reflector]
        if len(mine) < NEEDED:
            raise TooFewPointsError(
                f"axis {arc.axis}: {len(mine)} point{'s' if len(mine) != 1 else ''}, a circle needs {NEEDED}",
                rank=len(mine),
                needed=NEEDED,
                code="too_few",
                advice="record at least 12 over 90 degrees or more",
            )
    extent = np.linalg.svd(arc.points - arc.points.mean(axis=0), compute_uv=False)
    if extent[0] < _PLACE:
        raise DegenerateGeometryError(
            f"axis {arc.axis}: all points are one place",
            rank=0,
            needed=2,
            code="too_few",
            advice="turn this axis between the points",
        )
    if extent[1] < _LINE * extent[0]:
        raise DegenerateGeometryError(
            f"axis {arc.axis}: the points lie on one line ({mm(extent[1]):.3g} mm across), which fits every circle",
            rank=1,
            needed=2,
            code="too_few",
            advice="turn this axis further",
        )
    return ()


def _arc(found: ArcFit) -> Iterator[Warning_]:
    n = int(found.used.sum())
    if n < COMFORTABLE:
        known = (
            "" if found.fit.dof > 0 else ", and the noise is assumed to be a tracker's usual 15 um + 6 um/m"
        )
        yield Warning_(
            CHECK.key,
            f"axis {found.arc.axis}: only {n} points; a wrong one among them would not be seen{known}",
            "record 12 or more",
        )


CHECK = Check("too_few", "too few points", {"points": _points, "arc": _arc})
