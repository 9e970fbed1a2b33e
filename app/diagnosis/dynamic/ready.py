"""A table as a joint log in newton-metres with its motion: where diagnosis and judging begin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.dynamic.gains import estimated_gains
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.smoothing import Motion, motion_of
from app.diagnosis.observations.effort import GAIN
from app.diagnosis.observations.joint_log import Log, read_log
from app.diagnosis.thresholds.evidence import NOMINAL, TRUSTS
from app.diagnosis.wording import note
from app.errors import CellValueError
from app.estimation import plus_minus
from app.kinematics import RobotModel
from app.kinematics.dynamics import inverse_dynamics
from app.phrases import Said
from app.recordings import Table
from app.steps import part
from app.units import deg, mm

POSES = 200  # of a log, at which the weight of its joints is looked at


def ready(table: Table, robot: RobotModel) -> tuple[Log, Motion, frozenset[str]]:
    """The log in newton-metres, its motion, and effects it cannot tell.

    Raises:
        InputError: it cannot be used; names file, row and column.
    """
    with part(0.0, 0.5):
        log = read_log(table, robot)
    with part(0.5, 1.0):
        motion = motion_of(log, robot)
    without: frozenset[str] = frozenset()
    if log.lacking:
        gains, sigmas = estimated_gains(log, robot, motion, table)
        told = np.isfinite(sigmas)
        trust = NOMINAL * _trust(table)  # what is told by the weight is known as well as that is
        sigmas = np.hypot(sigmas, trust * gains)
        said = tuple(plus_minus(g, s, marked=False) for g, s in zip(gains[told], sigmas[told], strict=True))
        remarks = [note("gains_estimated" if log.lacking == GAIN else "stiffness_estimated", gains=said)]
        if not told.all():
            joints = tuple(int(j) + 1 for j in np.flatnonzero(~told))
            remarks.append(note("stiffness_untold", joints=joints, taken=f"{gains[~told][0]:.3g}"))
        stiffness = None if log.stiffness is None else np.where(told, gains, np.nan)
        notes = (*log.notes, *remarks[0 if told.any() else 1 :])
        log = replace(log, y=log.y * gains, lacking="", notes=notes, stiffness=stiffness)
        without = frozenset(key for key, law in laws().items() if law.gain)
    if log.stiffness is not None:
        log = replace(log, notes=(*log.notes, *_sag(log, robot, log.stiffness)))
    return log, motion, without


def _sag(log: Log, robot: RobotModel, stiffness: np.ndarray) -> tuple[Said, ...]:
    """How far each joint stands from its command under the weight it carries; nothing where no stiffness is known."""
    told = np.isfinite(stiffness)
    if not told.any() or not robot.has_inertials:
        return ()
    some = log.q[np.unique(np.linspace(0, len(log.q) - 1, POSES).astype(int))]
    weight = np.abs(inverse_dynamics(robot, some, 0.0 * some, 0.0 * some)).max(axis=0)
    sag = weight[told] / stiffness[told]
    sliding = np.array([joint.prismatic for joint in robot.joints])[told]
    said = (f"{mm(s):.3g} mm" if slides else f"{deg(s):.3g}°" for s, slides in zip(sag, sliding, strict=True))
    joints = (np.flatnonzero(told) + 1).tolist()
    return (note("servo_sag", sags=tuple(f"{j}: {s}" for j, s in zip(joints, said, strict=True))),)


def trust_of(table: Table) -> dict[str, float]:
    """How far the header says the description's masses may be off, over the nominal trust: a stretch of their law.

    Raises:
        CellValueError: it says nothing that can be understood.
    """
    return {key: _trust(table) for key, law in laws().items() if law.stated}


def _trust(table: Table) -> float:
    share = table.keys.get("inertial_prior")
    if share is not None:
        number = isinstance(share, int | float) and not isinstance(share, bool)
        if not number or not (np.isfinite(share) and share > 0):
            raise CellValueError(
                f"found {str(share)[:40]!r}",
                file=table.path,
                column="inertial_prior",
                expected="a positive share, such as 0.05",
            )
        return float(share) / NOMINAL
    stated = table.keys.get("inertials", "cad")
    if stated not in TRUSTS:
        raise CellValueError(
            f"found {str(stated)[:40]!r}", file=table.path, column="inertials", expected=" or ".join(TRUSTS)
        )
    return TRUSTS[str(stated)]
