"""The arcs do not start from one zero position."""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.checks import Check
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import deg, from_deg, mm

_ZERO = from_deg(0.05)  # a pendant shows hundredths


def _frame(base: BaseCalibration) -> Iterator[Warning_]:
    zero = base.zero
    if zero is None or not zero.known or abs(zero.angle) <= max(_ZERO, 5.0 * zero.sigma):
        return
    key = "zero_position_stated" if zero.stated else ""
    yield remark(CHECK.key, key, angle=deg(zero.angle), miss=mm(zero.miss))


CHECK = Check("zero_position", "axis 2 not turned from zero", {"frame": _frame})
