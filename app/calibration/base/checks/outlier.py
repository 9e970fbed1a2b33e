"""Rows that lie off the circle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.result import Warning_
from app.units import mm


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if not found.outliers:
        return
    rows = sorted(found.outliers)
    place = [int(np.flatnonzero((found.arc.rows == row) & ~found.used)[0]) for row in rows]
    far = np.linalg.norm(found.fit.residuals[place], axis=1)
    named = ", ".join(f"row {row} ({mm(d):.3f} mm)" for row, d in zip(rows, far, strict=True))
    yield Warning_(
        CHECK.key,
        f"axis {found.arc.axis}: {named} off the circle of the others, which keep within {mm(found.rms):.3f} mm; "
        f"set aside",
        "record them again, or find what broke the beam",
    )


CHECK = Check("outlier", "rows off the circle", {"arc": _arc})
