"""Two robots seen by one tracker: T_base1_base2, and how far two tools miss each other by it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from app.calibration.base.checks import look
from app.calibration.base.frame import adjoint, point_jacobian
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import phrase
from app.calibration.result import Warning_
from app.errors import DegenerateGeometryError
from app.estimation import reach
from app.geometry import Pose, fit_rigid
from app.phrases import Phrase

_ENOUGH = 3  # fixed points for a rigid motion


@dataclass(frozen=True, eq=False)
class Drift:
    """What the fixed points say about the tracker between two recordings.

    Args:
        names: fixed points that both recordings hold.
        shifts: (k,) [m] how far each seems to have moved.
        noise: [m] one-sigma of such a distance by the tracker's noise.
        moved: True where that is more than noise.
        T_first_second: the second recording's tracker frame in the first one's, where three or more points tell.
        covariance: (6, 6) of it, from the noise of the points.
    """

    names: tuple[str, ...]
    shifts: np.ndarray
    noise: float
    moved: bool
    T_first_second: Pose | None
    covariance: np.ndarray


@dataclass(frozen=True, eq=False)
class Relation:
    """The second robot's base in the first one's.

    Args:
        T_base1_base2: or None where the recordings cannot give it.
        covariance: (6, 6) of displacement and rotation in base 2's axes.
        first, second: both calibrations.
        meeting: (3,) [m] in base 1, where both tools are taken to meet.
        covariance_meeting: (3, 3) [m^2] of the miss there, in base 1's axes.
        drift: what fixed points say, or None where the files share none.
    """

    T_base1_base2: Pose | None
    covariance: np.ndarray
    first: BaseCalibration
    second: BaseCalibration
    meeting: np.ndarray
    covariance_meeting: np.ndarray
    drift: Drift | None = None
    warnings: tuple[Warning_, ...] = ()
    notes: tuple[Phrase, ...] = ()

    @property
    def sigma_meeting(self) -> float:
        """One-sigma length of the miss where the tools meet [m]."""
        return float(np.sqrt(np.trace(self.covariance_meeting)))

    @property
    def region_meeting(self) -> float:
        """Longest half axis of the region that holds the miss in 95 of 100 cases [m]."""
        return reach(0) * float(np.sqrt(max(np.linalg.eigvalsh(self.covariance_meeting)[-1], 0.0)))


def relate(first: BaseCalibration, second: BaseCalibration, meeting: np.ndarray | None = None) -> Relation:
    """T_base1_base2 = inv(T_tracker_base1) T_tracker_base2, with its covariance.

    Args:
        first, second: both robots, recorded with the tracker in one place.
        meeting: (3,) [m] in base 1; default half-way between the places both robots look at.

    Source: the patent's step 5; the covariance is this program's.
    """
    drift = tracker_drift(first.source.references, second.source.references, _noise(first, second))
    T1, T2 = first.T_tracker_base, second.T_tracker_base
    extra = np.zeros((6, 6))
    lost = False
    if drift is not None and drift.moved:
        lost = drift.T_first_second is None
        if drift.T_first_second is not None:
            T2 = drift.T_first_second @ T2
            extra = _carried(drift, second)
    T12 = T1.inverse() @ T2
    if meeting is None:
        front = T2.apply(second.T_tracker_base.inverse().apply(second.towards))
        meeting = T1.inverse().apply((first.towards + front) / 2.0)
    back = adjoint(T12.inverse())
    covariance = back @ first.covariance @ back.T + second.covariance + extra
    at = point_jacobian(T12.inverse().apply(meeting))
    there = T12.rotation @ at @ covariance @ at.T @ T12.rotation.T
    notes = () if drift is not None else (phrase("note.unchecked"),)
    relation = Relation(None if lost else T12, covariance, first, second, meeting, there, drift, notes=notes)
    return replace(relation, warnings=tuple(look("pair", relation)))


def _noise(first: BaseCalibration, second: BaseCalibration) -> float:
    return float(np.sqrt(np.mean([found.sigma**2 for found in (*first.arcs[:2], *second.arcs[:2])])))


def tracker_drift(
    before: Mapping[str, np.ndarray], after: Mapping[str, np.ndarray], noise: float
) -> Drift | None:
    """How the tracker's frame moved between two recordings, by the fixed points both hold.

    Args:
        before, after: name -> (k, 3) [m].
        noise: one-sigma of a coordinate [m].

    Returns:
        Drift, or None where no name stands in both.
    """
    names = tuple(name for name in before if name in after)
    if not names:
        return None
    a = np.array([before[name].mean(axis=0) for name in names])
    b = np.array([after[name].mean(axis=0) for name in names])
    shifts = np.linalg.norm(a - b, axis=1)
    one = float(noise * np.sqrt(2.0))
    moved = bool(np.any(shifts > 5.0 * one))
    motion, covariance = None, np.zeros((6, 6))
    if len(names) >= _ENOUGH:
        try:
            motion = fit_rigid(b, a)
        except DegenerateGeometryError:
            motion = None
        if motion is not None:
            rows = point_jacobian(b).reshape(-1, 6)
            covariance = one**2 * np.linalg.inv(rows.T @ rows)
    return Drift(names, shifts, one, moved, motion, covariance)


def _carried(drift: Drift, second: BaseCalibration) -> np.ndarray:
    """Uncertainty of the way back over the fixed points, in the axes of base 2."""
    j = adjoint(second.T_tracker_base.inverse())
    return j @ drift.covariance @ j.T
