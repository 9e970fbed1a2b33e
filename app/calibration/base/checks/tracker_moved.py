"""The tracker stood elsewhere for the second robot, seen by fixed points that both recordings hold."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.checks import Check
from app.calibration.base.relation import Relation
from app.calibration.result import Warning_
from app.units import deg, mm


def _pair(relation: Relation) -> Iterator[Warning_]:
    drift = relation.drift
    if drift is None or not drift.moved:
        return
    worst = int(np.argmax(drift.shifts))
    seen = (
        f"the tracker moved between the robots: fixed point {drift.names[worst]!r} stands "
        f"{mm(drift.shifts[worst]):.3f} mm elsewhere in the second file (noise {mm(drift.noise):.3f})"
    )
    if drift.T_first_second is None:
        yield Warning_(
            CHECK.key,
            f"{seen}; {len(drift.names)} common point(s) do not give the way back, so there is no T_base1_base2",
            "measure three or more fixed points with both robots, or record both again",
            severe=True,
        )
        return
    motion = drift.T_first_second
    yield Warning_(
        CHECK.key,
        f"{seen}; by {len(drift.names)} fixed points it moved {mm(np.linalg.norm(motion.position)):.2f} mm and "
        f"{deg(np.linalg.norm(motion.rotvec)):.4f} degrees, which T_base1_base2 takes into account",
        "better record both robots from one place",
        severe=True,
    )


CHECK = Check("tracker_moved", "tracker moved between the robots", {"pair": _pair})
