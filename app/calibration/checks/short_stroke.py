"""A stroke so short that the noise of its two ends turns the axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture
from app.calibration.checks._strokes import strokes
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import remark
from app.units import deg, from_mm, mm

ASKED = from_mm(100.0)
_SLACK = 0.95
#: Noise of a touch where the fit cannot tell it [m].
_USUAL_NOISE = from_mm(0.3)


@dataclass(frozen=True)
class ShortStroke:
    key: str = "short_stroke"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        found = []
        noise = max(result.sigma, _USUAL_NOISE)
        for name, vector in strokes(result, captures).items():
            length = float(np.linalg.norm(vector))
            if length < _SLACK * ASKED:
                off = deg(np.arctan2(np.sqrt(2.0) * noise, length))
                found.append(
                    remark(
                        self.key,
                        axis=name.upper(),
                        length=mm(length),
                        noise=mm(noise),
                        deg=off,
                        asked=mm(ASKED),
                    )
                )
        return found


CHECK = ShortStroke()
