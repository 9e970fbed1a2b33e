"""Two touches with almost the same orientation: every touch is compared with every other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, of_role, stack
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import phrase, remark
from app.geometry import angle_between
from app.units import deg, from_deg

ALIKE = from_deg(8.0)
#: With more touches than this, some must be alike.
_MANY = 12
_SHOWN = 3


@dataclass(frozen=True)
class TooAlike:
    key: str = "too_alike"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        for role in ("touch", "plane"):
            rotations, _ = stack(of_role(captures, role))
            if 2 <= len(rotations) <= _MANY:
                return self._pairs(rotations)
        return []

    def _pairs(self, rotations: np.ndarray) -> list[Warning_]:
        first, second = np.triu_indices(len(rotations), 1)
        angles = angle_between(rotations[first], rotations[second])
        close = [k for k in np.argsort(angles) if angles[k] < ALIKE]
        if not close:
            return []
        pairs: object = tuple(
            phrase(
                "check.too_alike_pair",
                first=int(first[k]) + 1,
                second=int(second[k]) + 1,
                deg=float(deg(angles[k])),
            )
            for k in close[:_SHOWN]
        )
        if len(close) > _SHOWN:
            pairs = phrase("check.too_alike_more", pairs=pairs, count=len(close) - _SHOWN)
        return [remark(self.key, pairs=pairs, touch=int(second[close[0]]) + 1)]


CHECK = TooAlike()
