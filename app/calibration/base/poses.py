"""The base from tracked poses: any poses, the robot's description and one reflector.

Model: p_tracker = T_tracker_base (p_flange(q) + R_flange(q) t), six unknowns of the base and the reflector's
place t in the flange. It trusts the description, which arcs do not need; so it is judged on poses left out.

A row that the others exclude (a beam that was broken, a reflector that fell off) is set aside and named: rows are
taken out from the farthest on, half the way to the next each time, and one that the rest explain after all is taken
back. What counts is how far a row lies from the prediction of a fit that has not seen it: beyond `FAR` times the
others' distance, and rarer under Fisher's distribution than once in 1/`RARE` recordings.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from app.calibration.base.wording import degenerate
from app.errors import TooFewPointsError
from app.estimation import Fit, gauss_newton
from app.geometry import Pose, angle_between, exp_so3, fit_rigid, nearest_rotation, skew
from app.units import MM_PER_INCH, MM_PER_M

FEWEST = 6  # poses: 9 unknowns, and something left to judge by
FOLDS = 5
#: A row farther off than so many times the root mean square distance of the others is not one of them.
FAR = 5.0
#: How often a recording without any wrong row may lose one.
RARE = 1e-3
#: No more than this share of the rows is set aside: beyond, nobody can say which half is wrong.
MOST = 0.25
#: Units that are taken for another: metres for millimetres, inches for millimetres; and the other way round.
SCALES = (MM_PER_M, MM_PER_INCH)
#: Another unit is believed where it makes the residual so many times smaller.
SCALE_BETTER = 5.0
#: Median length of a three-dimensional normal vector with unit noise on each axis.
_MEDIAN_LENGTH = 1.5382


@dataclass(frozen=True, eq=False)
class PoseBase:
    """A base found from poses.

    Args:
        T_tracker_base: base link of the description in the tracker.
        reflector: (3,) in the flange [m].
        covariance: (6, 6) of displacement and rotation in the base's own axes, see frame.py.
        fit: unknowns with their uncertainty; its residuals are (3 n,).
        heldout: (n,) distance [m] between measured and predicted point of every pose, each predicted by a fit
            that had not seen it, without those set aside.
        count: poses.
        wrist: [rad] largest turn of the flange between any pose and their mean.
        aside: indices of poses that the others exclude; they are in nothing of the above but `count`.
        off: (len(aside),) how far each of them lies from where the others put it [m].
        scale: factor on the measured points that makes them fit, and how many times better; None where 1 does.
    """

    T_tracker_base: Pose
    reflector: np.ndarray
    covariance: np.ndarray
    fit: Fit
    heldout: np.ndarray
    count: int
    wrist: float = 0.0
    aside: tuple[int, ...] = ()
    off: tuple[float, ...] = ()
    scale: tuple[float, float] | None = None

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
    whole = _fit(rotations, positions, measured)
    if whole.rank < 9:
        raise degenerate("degenerate", "open_poses", rank=whole.rank, needed=9)
    scale = _scale(whole, rotations, positions, measured)
    used, off = _used(whole, rotations, positions, measured)
    aside = tuple(int(i) for i in np.flatnonzero(~used))
    rotations, positions, measured = rotations[used], positions[used], measured[used]
    fit = _fit(rotations, positions, measured) if aside else whole
    heldout = np.empty(len(measured))
    folds = np.arange(len(measured)) % FOLDS
    for fold in range(FOLDS):
        out = folds == fold
        part = _fit(rotations[~out], positions[~out], measured[~out])
        heldout[out] = _distances(part, rotations[out], positions[out], measured[out])
    base = _pose(fit.values)
    mean = nearest_rotation(rotations.mean(axis=0))
    wrist = float(np.max(angle_between(np.broadcast_to(mean, rotations.shape), rotations)))
    return PoseBase(
        base,
        fit.values[6:9].copy(),
        fit.covariance[:6, :6].copy(),
        fit,
        heldout,
        n,
        wrist,
        aside,
        tuple(float(v) for v in off),
        scale,
    )


def _scale(
    whole: Fit, rotations: np.ndarray, positions: np.ndarray, measured: np.ndarray
) -> tuple[float, float] | None:
    """The factor by which the points are too small or too large for this arm, and by how much it betters the fit."""
    best, better = 1.0, 1.0
    for factor in (*SCALES, *(1.0 / factor for factor in SCALES)):
        found = _fit(rotations, positions, factor * measured)
        ratio = found.rms / max(whole.rms, 1e-12)
        if ratio < 1.0 / better:
            best, better = factor, 1.0 / max(ratio, 1e-12)
    return (best, better) if better > SCALE_BETTER else None


def _used(
    whole: Fit, rotations: np.ndarray, positions: np.ndarray, measured: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """(n,) rows that belong together, and the distance [m] of each of the others from where these put it."""
    n = len(measured)
    used, fit = np.ones(n, bool), whole
    fewest = max(FEWEST, n - int(MOST * n))
    for _ in range(n):
        lengths = _distances(fit, rotations, positions, measured)
        scale = np.median(lengths[used]) / _MEDIAN_LENGTH * np.sqrt(3.0 * used.sum() / max(fit.dof, 1))
        suspects = used & (lengths > FAR * scale) & (lengths >= 0.5 * lengths[used].max())
        if not suspects.any() or used.sum() - suspects.sum() < fewest:
            break
        trial = used & ~suspects
        found = _fit(rotations[trial], positions[trial], measured[trial])
        if found.rank < 9:
            break
        used, fit = trial, found
    lengths = _distances(fit, rotations, positions, measured)
    typical = float(np.sqrt(np.mean(lengths[used] ** 2)))
    rare = special.fdtri(3, max(fit.dof, 1), 1.0 - RARE / n)
    beyond = (lengths > FAR * typical) & (lengths**2 / 3.0 > rare * fit.sigma**2)
    used = ~beyond | used
    return used, lengths[~used]


def _distances(fit: Fit, rotations: np.ndarray, positions: np.ndarray, measured: np.ndarray) -> np.ndarray:
    """(n,) between measured and predicted point [m]."""
    return np.linalg.norm(measured - _predict(fit.values, rotations, positions), axis=1)


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
