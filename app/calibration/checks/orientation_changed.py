"""The tool was turned between the origin and a stroke's end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from app.calibration.captures import Capture, of_role
from app.calibration.checks._strokes import AXES
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import remark
from app.geometry import angle_between
from app.units import deg, from_deg

NOTICED, SEVERE = from_deg(0.5), from_deg(3.0)


@dataclass(frozen=True)
class OrientationChanged:
    key: str = "orientation_changed"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        found = []
        for origin in of_role(captures, "origin")[:1]:
            for name in AXES:
                for capture in of_role(captures, name)[:1]:
                    angle = float(
                        angle_between(origin.T_base_flange.rotation, capture.T_base_flange.rotation)
                    )
                    if angle > NOTICED:
                        found.append(
                            remark(self.key, severe=angle > SEVERE, deg=deg(angle), axis=name.upper())
                        )
        return found


CHECK = OrientationChanged()
