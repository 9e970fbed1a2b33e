"""A stroke so short that the noise of its two ends turns the axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture
from app.calibration.checks._strokes import strokes
from app.calibration.result import ToolCalibration, Warning_
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
                    Warning_(
                        self.key,
                        f"the stroke along {name.upper()} is {mm(length):.1f} mm long only: "
                        f"a noise of {mm(noise):.2f} mm turns the axis by {off:.1f} degrees",
                        f"move {mm(ASKED):.0f} mm or more along {name.upper()} before recording it",
                    )
                )
        return found


CHECK = ShortStroke()
