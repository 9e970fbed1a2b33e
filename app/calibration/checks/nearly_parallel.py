"""Two strokes that point almost the same way or against each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from app.calibration.captures import Capture
from app.calibration.checks._strokes import strokes
from app.calibration.result import ToolCalibration, Warning_
from app.units import deg, from_deg

#: Strokes closer to one line than this are refused as a result; closer to square than the other are fine [rad].
SEVERE, SQUARE = from_deg(30.0), from_deg(10.0)


@dataclass(frozen=True)
class NearlyParallel:
    key: str = "nearly_parallel"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        found = []
        for (a, u), (b, v) in combinations(strokes(result, captures).items(), 2):
            angle = float(np.arctan2(np.linalg.norm(np.cross(u, v)), u @ v))
            if min(angle, np.pi - angle) < SEVERE:
                found.append(
                    Warning_(
                        self.key,
                        f"the strokes along {a.upper()} and {b.upper()} stand at {deg(angle):.1f} degrees: "
                        "the plane of the two is poorly known",
                        f"record {b.upper()} again, at a right angle to {a.upper()}",
                        severe=True,
                    )
                )
            elif abs(angle - np.pi / 2) > SQUARE:
                found.append(
                    Warning_(
                        "not_square",
                        f"the strokes along {a.upper()} and {b.upper()} stand at {deg(angle):.1f} degrees, not at 90",
                        "jog along the tool's axes, not by eye, and record the strokes again",
                    )
                )
        return found


CHECK = NearlyParallel()
