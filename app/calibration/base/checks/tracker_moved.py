"""The tracker stood elsewhere for the second robot, seen by fixed points that both recordings hold."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.checks import Check
from app.calibration.base.relation import Relation
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import deg, mm


def _pair(relation: Relation) -> Iterator[Warning_]:
    drift = relation.drift
    if drift is None or not drift.moved:
        return
    worst = int(np.argmax(drift.shifts))
    seen = {
        "name": drift.names[worst],
        "shift": mm(drift.shifts[worst]),
        "noise": mm(drift.noise),
        "count": len(drift.names),
    }
    if drift.T_first_second is None:
        yield remark(CHECK.key, "tracker_lost", severe=True, **seen)
        return
    motion = drift.T_first_second
    yield remark(
        CHECK.key,
        severe=True,
        moved=mm(np.linalg.norm(motion.position)),
        turned=deg(np.linalg.norm(motion.rotvec)),
        **seen,
    )


CHECK = Check("tracker_moved", "tracker moved between the robots", {"pair": _pair})
