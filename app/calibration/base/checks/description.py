"""Axes that do not lie as the robot's description says."""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.checks import Check
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import deg, from_deg, from_mm, mm

_LENGTH, _ANGLE = from_mm(5.0), from_deg(1.0)  # no arm leaves its maker this far off


def _frame(base: BaseCalibration) -> Iterator[Warning_]:
    maker = base.maker
    if maker is None:
        return
    length = base.offset - maker.offset_nominal
    angle = base.angle - maker.angle_nominal
    if abs(length) > _LENGTH + 5 * base.offset_sigma or abs(angle) > _ANGLE + 5 * base.angle_sigma:
        yield remark(
            CHECK.key,
            severe=True,
            offset=mm(base.offset),
            angle=deg(base.angle),
            robot=maker.robot,
            nominal_offset=mm(maker.offset_nominal),
            nominal_angle=deg(maker.angle_nominal),
        )


CHECK = Check("description", "axes unlike the description's", {"frame": _frame})
