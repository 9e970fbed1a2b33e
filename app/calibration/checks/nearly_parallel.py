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
from app.calibration.wording import remark
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
            fields = {"first": a.upper(), "second": b.upper(), "deg": deg(angle)}
            if min(angle, np.pi - angle) < SEVERE:
                found.append(remark(self.key, severe=True, **fields))
            elif abs(angle - np.pi / 2) > SQUARE:
                found.append(remark("not_square", **fields))
        return found


CHECK = NearlyParallel()
