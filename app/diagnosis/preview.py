"""A recording beside the bare description, before anybody has searched: what the Compare screen shows first."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from app.diagnosis.dispatch import check_joints, family, kind_of
from app.diagnosis.result import Evidence
from app.kinematics import RobotModel
from app.recordings import Table


def preview(table: Table, robot: RobotModel) -> Evidence:
    """Evidence with `before` only (`after` is the same): base and tool fitted, nothing searched for.

    A motion recording shows what was measured; what the description predicts needs the search's own filters, so its
    residuals are NaN until then.

    Raises:
        InputError, DegenerateGeometryError: the recording cannot be used.
    """
    kind, _ = kind_of(table)
    check_joints(table, robot)
    return _motion(table, robot) if family(kind) == "motion" else _static(table, robot)


def _static(table: Table, robot: RobotModel) -> Evidence:
    from app.diagnosis.static.diagnose import plain_fit
    from app.diagnosis.static.evidence import evidence_of
    from app.diagnosis.static.reading import read_static

    recording = read_static(table, robot)
    plain = plain_fit(recording, ())
    nothing = SimpleNamespace(
        before=plain, found=SimpleNamespace(fitted=plain), outliers=np.zeros(recording.size, bool)
    )
    return evidence_of(recording, nothing)


def _motion(table: Table, robot: RobotModel) -> Evidence:
    from app.diagnosis.motion.log import read_log

    log = read_log(table, robot)
    unknown = np.full_like(log.y, np.nan)
    return Evidence(
        rows=log.rows,
        measured=log.y,
        before=unknown,
        after=unknown,
        components=tuple(f"joint {j + 1}" for j in range(robot.joint_count)),
        unit="Nm",
        q=log.q,
        drivers={},
        kept=np.ones(len(log.t), bool),
        t=log.t,
    )
