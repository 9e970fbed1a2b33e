"""Too few points for a circle, or too few to judge one."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.arcs import Arc
from app.calibration.base.checks import Check
from app.calibration.base.wording import degenerate, remark
from app.calibration.result import Warning_
from app.errors import TooFewPointsError
from app.units import from_um, mm

NEEDED = 3
COMFORTABLE = 6
_LINE = 1e-4  # second over first extent of the points below which they lie on one line
_PLACE = from_um(1)


def _points(arc: Arc) -> tuple[Warning_, ...]:
    for reflector in np.unique(arc.reflectors):
        mine = arc.points[arc.reflectors == reflector]
        if len(mine) < NEEDED:
            raise degenerate(
                CHECK.key,
                "too_few_one" if len(mine) == 1 else "",
                kind=TooFewPointsError,
                rank=len(mine),
                needed=NEEDED,
                axis=arc.axis,
                count=len(mine),
            )
    extent = np.linalg.svd(arc.points - arc.points.mean(axis=0), compute_uv=False)
    if extent[0] < _PLACE:
        raise degenerate(CHECK.key, "one_place", rank=0, needed=2, axis=arc.axis)
    if extent[1] < _LINE * extent[0]:
        raise degenerate(CHECK.key, "one_line", rank=1, needed=2, axis=arc.axis, across=mm(extent[1]))
    return ()


def _arc(found: ArcFit) -> Iterator[Warning_]:
    n = int(found.used.sum())
    if n < COMFORTABLE:
        key = "" if found.fit.dof > 0 else "too_few_unknown"
        yield remark(CHECK.key, key, axis=found.arc.axis, count=n)


CHECK = Check("too_few", "too few points", {"points": _points, "arc": _arc})
