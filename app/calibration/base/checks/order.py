"""Rows out of order, or angles that do not fit the places they were written beside."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.arcfit import ANGLE_TOLERANCE, ArcFit
from app.calibration.base.checks import Check
from app.calibration.base.wording import degenerate, phrase, remark
from app.calibration.result import Warning_
from app.phrases import Phrase
from app.units import deg

_SHOWN = 8


def _rows(found: ArcFit) -> Phrase:
    rows = sorted(set(found.arc.rows[found.sense.odd].tolist()))
    key = "one" if len(rows) == 1 else "many" if len(rows) <= _SHOWN else "more"
    return phrase(f"rows.{key}", rows=tuple(rows[:_SHOWN]), count=len(rows) - _SHOWN)


def _arc(found: ArcFit) -> Iterator[Warning_]:
    axis, sense = found.arc.axis, found.sense
    with_angles = found.arc.angles is not None
    if sense.sign == 0:
        raise degenerate(CHECK.key, "order_angles" if with_angles else "order_rows", axis=axis)
    if not sense.odd.any():
        return
    if with_angles:
        assert sense.gap is not None
        worst = float(np.nanmax(np.abs(sense.gap)))
        yield remark(
            CHECK.key,
            "order_angles",
            axis=axis,
            rows=_rows(found),
            worst=deg(worst),
            limit=deg(ANGLE_TOLERANCE),
        )
    else:
        yield remark(CHECK.key, "order_rows", axis=axis, rows=_rows(found))


CHECK = Check("order", "wrong order of rows or angles", {"arc": _arc})
