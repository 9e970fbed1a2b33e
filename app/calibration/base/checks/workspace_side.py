"""A work-space point that does not say which way X looks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.checks import Check
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import mm

_SHARE = 0.02  # of the radius, the same limit as in solve.py


def _frame(base: BaseCalibration) -> Iterator[Warning_]:
    reach = float((base.towards - base.T_tracker_base.position) @ base.T_tracker_base.rotation[:, 0])
    stated = base.source.towards is not None
    limit = 1e-3 if stated else _SHARE * base.first.radius
    if np.abs(reach) > limit:
        return
    yield remark(CHECK.key, "workspace_side_stated" if stated else "", reach=mm(abs(reach)))


CHECK = Check("workspace_side", "no clear front", {"frame": _frame})
