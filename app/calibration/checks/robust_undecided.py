"""The robust estimator was asked for, the touches disagree, and there are too few to say which one is off."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from app.calibration.captures import Capture
from app.calibration.quality.light import Limits
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import remark
from app.units import mm

#: So few touches may agree on the wrong point.
FEW = 4
#: A touch that counts less than this was told from the others.
_TOLD = 0.5


@dataclass(frozen=True)
class RobustUndecided:
    key: str = "robust_undecided"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        count = len(result.weights)
        if result.method != "robust" or not 3 <= count <= FEW or result.mean <= Limits().mean_yellow:
            return []
        if result.weights.min() < _TOLD:
            return []
        return [remark(self.key, count=count, mean=mm(result.mean))]


CHECK = RobustUndecided()
