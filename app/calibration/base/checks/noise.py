"""Residuals that deny the noise that was stated."""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import mm


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if found.stated and found.scale > 1.0:
        yield remark(CHECK.key, axis=found.arc.axis, times=found.scale**0.5, rms=mm(found.rms))


CHECK = Check("noise", "more noise than stated", {"arc": _arc})
