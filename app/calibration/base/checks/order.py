"""Rows out of order, or angles that do not fit the places they were written beside."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.arcfit import ANGLE_TOLERANCE, ArcFit
from app.calibration.base.checks import Check
from app.calibration.result import Warning_
from app.errors import DegenerateGeometryError
from app.units import deg


def _rows(found: ArcFit) -> str:
    rows = sorted(set(found.arc.rows[found.sense.odd].tolist()))
    more = f" and {len(rows) - 8} more" if len(rows) > 8 else ""
    return ("row " if len(rows) == 1 else "rows ") + ", ".join(map(str, rows[:8])) + more


def _arc(found: ArcFit) -> Iterator[Warning_]:
    axis, sense = found.arc.axis, found.sense
    with_angles = found.arc.angles is not None
    if sense.sign == 0:
        what = (
            "the angles written do not follow the turn about its axis"
            if with_angles
            else "its rows run to and fro, so that the direction of positive motion cannot be told"
        )
        raise DegenerateGeometryError(
            f"axis {axis}: {what}",
            code=CHECK.key,
            advice="check unit and sign of angle_deg"
            if with_angles
            else "add angle_deg, or put the rows in order",
        )
    if not sense.odd.any():
        return
    if with_angles:
        assert sense.gap is not None
        worst = float(np.nanmax(np.abs(sense.gap)))
        yield Warning_(
            CHECK.key,
            f"axis {axis}: the angle of {_rows(found)} is up to {deg(worst):.2f} degrees away from the place on "
            f"the circle (more than {deg(ANGLE_TOLERANCE):.1f})",
            "were rows or angles interchanged?",
        )
    else:
        yield Warning_(
            CHECK.key,
            f"axis {axis}: {_rows(found)} steps against the direction of the others",
            "put the rows in the order of motion, or add angle_deg",
        )


CHECK = Check("order", "wrong order of rows or angles", {"arc": _arc})
