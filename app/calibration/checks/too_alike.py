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

#: Touches nearer than this count as one orientation: with 0.3 mm of noise an axis, two that are 8 degrees apart tell
#: the tool across them to 0.3 sqrt(2) / 0.14 = 3 mm, three times what KUKA's training lets pass (1 mm).
ALIKE = from_deg(8.0)
#: With so many different orientations one that comes again is no fault: it tells whether something moved meanwhile,
#: and lessons ask for it. Of touches of a point, four: the number of KUKA's XYZ 4-point, of ABB's default and of the
#: paper's example (Xiong 2012, Table 1). With tilts to 30 degrees and 0.3 mm, three and the first again leave 1.2 mm
#: where another orientation leaves 0.8; four and the first again leave 0.74 and another 0.62, both under 1 mm (from
#: predicted_covariance, the median of 200 sets). Of a plate, whose touches tell one number each, six: its unknowns.
_ENOUGH = {"touch": 4, "plane": 6}
_SHOWN = 3
_LOOKED_AT = 500  # touches whose pairs are listed: more tell nothing else, and pairs grow with their square


@dataclass(frozen=True)
class TooAlike:
    key: str = "too_alike"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        if of_role(captures, "known"):  # the known tool says where the point is: one orientation is enough
            return []
        for role, enough in _ENOUGH.items():
            rotations, _ = stack(of_role(captures, role))
            most = min(enough, len(rotations))
            if len(rotations) >= 2 and distinct(rotations, most) < most:
                return self._pairs(rotations[:_LOOKED_AT])
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


def distinct(rotations: np.ndarray, most: int) -> int:
    """How many of the orientations (n, 3, 3) differ: each is set beside those that were counted before; counts to
    `most`."""
    count = 0
    while len(rotations) and count < most:
        count += 1
        rotations = rotations[angle_between(rotations[0], rotations) >= ALIKE]
    return count


CHECK = TooAlike()
