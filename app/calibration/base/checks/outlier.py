"""Rows that lie off the circle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.base.wording import phrase, remark
from app.calibration.result import Warning_
from app.units import mm


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if not found.outliers:
        return
    rows = sorted(found.outliers)
    place = [int(np.flatnonzero((found.arc.rows == row) & ~found.used)[0]) for row in rows]
    far = np.linalg.norm(found.fit.residuals[place], axis=1)
    named = tuple(phrase("rows.off", row=row, off=mm(float(d))) for row, d in zip(rows, far, strict=True))
    yield remark(CHECK.key, axis=found.arc.axis, rows=named, rms=mm(found.rms))


CHECK = Check("outlier", "rows off the circle", {"arc": _arc})
