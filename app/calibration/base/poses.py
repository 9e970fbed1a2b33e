"""The base from tracked poses: any poses, the robot's description and one reflector.

Model: p_tracker = T_tracker_base (p_flange(q) + R_flange(q) t), six unknowns of the base and the reflector's
place t in the flange. It trusts the description, which arcs do not need; so it is judged on poses left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.wording import degenerate
from app.errors import TooFewPointsError
from app.estimation import Fit, gauss_newton
from app.geometry import Pose, angle_between, exp_so3, fit_rigid, nearest_rotation, skew

FEWEST = 6  # poses: 9 unknowns, and something left to judge by
FOLDS = 5


@dataclass(frozen=True, eq=False)
class PoseBase:
    """A base found from poses.

    Args:
        T_tracker_base: base link of the description in the tracker.
        reflector: (3,) in the flange [m].
        covariance: (6, 6) of displacement and rotation in the base's own axes, see frame.py.
        fit: unknowns with their uncertainty; its residuals are (3 n,).
        heldout: (n,) distance [m] between measured and predicted point of every pose, each predicted by a fit
            that had not seen it.
        count: poses.
        wrist: [rad] largest turn of the flange between any pose and their mean.
    """

    T_tracker_base: Pose
    reflector: np.ndarray
    covariance: np.ndarray
    fit: Fit
    heldout: np.ndarray
    count: int
    wrist: float = 0.0

    @property
    def heldout_rms(self) -> float:
        """Root mean square of the left-out distances [m]."""
        return float(np.sqrt(np.mean(self.heldout**2)))


def base_from_poses(rotations: np.ndarray, positions: np.ndarray, measured: np.ndarray) -> PoseBase:
    """Base and reflector that explain the measured points, and how well they explain others.

    Args:
        rotations: (n, 3, 3) R_base_flange by the description.
        positions: (n, 3) [m] of the flange in base.
        measured: (n, 3) [m] in the tracker's frame.

    Raises:
        TooFewPointsError: fewer than six poses.
        DegenerateGeometryError: the poses leave base or reflector open.
    """
    n = len(measured)
    if n < FEWEST:
        raise degenerate("too_few", "few_poses", kind=TooFewPointsError, rank=n, needed=FEWEST, count=n)
    fit = _fit(rotations, positions, measured)
    if fit.rank < 9:
        raise degenerate("degenerate", "open_poses", rank=fit.rank, needed=9)
    heldout = np.empty(n)
    folds = np.arange(n) % FOLDS
    for fold in range(FOLDS):
        out = folds == fold
        part = _fit(rotations[~out], positions[~out], measured[~out])
        heldout[out] = np.linalg.norm(
            measured[out] - _predict(part.values, rotations[out], positions[out]), axis=1
        )
    base = _pose(fit.values)
    mean = nearest_rotation(rotations.mean(axis=0))
    wrist = float(np.max(angle_between(np.broadcast_to(mean, rotations.shape), rotations)))
    return PoseBase(base, fit.values[6:9].copy(), fit.covariance[:6, :6].copy(), fit, heldout, n, wrist)


def _pose(values: np.ndarray) -> Pose:
    return Pose.of(exp_so3(values[3:6]), values[:3])


def _predict(values: np.ndarray, rotations: np.ndarray, positions: np.ndarray) -> np.ndarray:
    return _pose(values).apply(positions + rotations @ values[6:9])


def _fit(rotations: np.ndarray, positions: np.ndarray, measured: np.ndarray) -> Fit:
    first = fit_rigid(positions, measured)
    start = np.concatenate([first.position, first.rotvec, np.zeros(3)])

    def residual(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        base = _pose(x)
        local = positions + rotations @ x[6:9]  # (n, 3) in base
        columns = np.empty((len(measured), 3, 9))
        columns[:, :, :3] = base.rotation  # displacement and turn in the base's own axes
        columns[:, :, 3:6] = base.rotation @ -skew(local)
        columns[:, :, 6:] = base.rotation @ rotations
        return (measured - base.apply(local)).ravel(), columns.reshape(-1, 9)

    def move(x: np.ndarray, step: np.ndarray) -> np.ndarray:
        after = _pose(x) @ Pose.exp(step[:6])
        return np.concatenate([after.position, after.rotvec, x[6:9] + step[6:9]])

    return gauss_newton(
        residual,
        start,
        names=("x", "y", "z", "turn_x", "turn_y", "turn_z", "reflector_x", "reflector_y", "reflector_z"),
        units=("m", "m", "m", "rad", "rad", "rad", "m", "m", "m"),
        update=move,
    )
