"""How far each row is trusted: a t distribution of the residuals, or a normal one where that is likelier."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.kinematic.state import State, settled, started
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.thresholds.rows import ALMOST, HEADROOM, OUTLIER_WEIGHT, ROBUST_DOF
from app.errors import TeachframeError

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.terms import Term


#: Median of a chi-square over its degrees of freedom, by degrees of freedom: for a robust first scale.
_MEDIAN = {1: 0.455, 3: 0.789, 6: 0.891, 9: 0.927}
#: m, rad: no instrument is better; keeps weights finite on simulated data without noise.
_FINEST = 1e-9
#: Sum of squares a component beyond which a row counts no more when two states are compared (five sigma).
_FAR = 25.0


def first_weights(recording: StaticRecording) -> np.ndarray:
    """(m, k) before any fit: 0.3 mm, and 1 mrad for measured orientation."""
    return recording.present * np.sqrt(recording.worth) / np.where(recording.angular, 1e-3, 3e-4)


def compared(recording: StaticRecording, held: tuple[Term, ...], steps: int) -> State | None:
    """A set-up fitted by a few steps, effects held, only to be compared with others; None where there is none."""
    try:
        return settled(started(recording, held, first_weights(recording)), steps)
    except (TeachframeError, np.linalg.LinAlgError):
        return None


def row_weights(
    recording: StaticRecording, residual: np.ndarray, used: float
) -> tuple[np.ndarray, np.ndarray]:
    """Weights of the components and of the rows.

    Each kind of component (positions, angles) gets the scale of a distribution of its own, and is weighed by itself: a
    mark that was seen badly says nothing against the point. A row's weight is that of its point, if it has one. Rows
    that do not belong are set aside; the others are weighed by a t distribution where their residuals have heavy tails,
    and alike where they are normal.

    Args:
        residual: (m, k) [m, rad].
        used: fitted parameters, for the degrees of freedom of the scale.

    Returns:
        weights (m, k) one over sigma times the root of the row's weight, and rows (m,) in 0..1.
    """
    sigma = np.ones(residual.shape[1])
    rows, seen, parts = np.ones(recording.size), np.zeros(recording.size, bool), np.ones(residual.shape)
    total = _independent(recording)
    for kind, squares, count in _kinds(recording, residual):  # positions first
        here = count > 0
        share = used * float(count.sum() * recording.worth[kind][0]) / total
        variance, weight = _fitted(squares[here], count[here], share)
        sigma[kind] = np.sqrt(variance)
        parts[np.ix_(here, kind)] = weight[:, None]
        rows[here] = np.where(seen[here], rows[here], weight)
        seen |= here
    return recording.present * (np.sqrt(recording.worth) / sigma) * np.sqrt(parts), rows


def even_weights(recording: StaticRecording, residual: np.ndarray, used: float) -> np.ndarray:
    """(m, k) one over the plain root mean square of each kind of component; every row counts alike."""
    sigma = np.ones(residual.shape[1])
    total = _independent(recording)
    for kind, squares, count in _kinds(recording, residual):
        free = max(float(count.sum()) - used * float(count.sum() * recording.worth[kind][0]) / total, 1.0)
        sigma[kind] = max(float(np.sqrt(squares.sum() / free)), _FINEST)
    return recording.present * (np.sqrt(recording.worth) / sigma)


def t_likelihood(recording: StaticRecording, residual: np.ndarray, used: float, unit: float = 1.0) -> float:
    """Log likelihood of a residual under multivariate t distributions of fitted scale [nats].

    Args:
        unit: how many of the lengths that are compared one of this recording is.
    """
    out = 0.0
    total = _independent(recording)
    for kind, squares, count in _kinds(recording, residual):
        here = count > 0
        variance, _ = _t_scale(
            squares[here], count[here], used * float(count.sum() * recording.worth[kind][0]) / total
        )
        metric = not recording.angular[kind][0]
        scale = 0.5 * np.log(variance) + (np.log(unit) if metric else 0.0)
        out -= float(recording.worth[kind][0]) * float(
            np.sum(0.5 * (ROBUST_DOF + count) * np.log1p(squares / variance / ROBUST_DOF) + count * scale)
        )
    return out


def robust_squares(state: State) -> float:
    """Weighted sum of squares, a row counting for no more than five sigma a component."""
    rows = (state.residual * state.weights) ** 2
    return float(np.minimum(rows.sum(axis=1), _FAR * rows.shape[1]).sum())


def _independent(recording: StaticRecording) -> float:
    """Number of independent measurements that a recording is worth."""
    return max(float(recording.present.sum(axis=0) @ recording.worth), 1.0)


def weighted_anew(state: State, used: float) -> tuple[np.ndarray, np.ndarray]:
    """`row_weights` of a state's residual."""
    return row_weights(state.recording, state.residual, used)


def _kinds(recording: StaticRecording, residual: np.ndarray):
    """(k,) mask of each kind of component with its sum of squares and count in every row."""
    for angular in (False, True):
        kind = recording.angular == angular
        if kind.any():
            present = recording.present[:, kind]
            yield kind, np.where(present, residual[:, kind] ** 2, 0.0).sum(axis=1), present.sum(axis=1)


def _fitted(squares: np.ndarray, count: np.ndarray, used: float) -> tuple[float, np.ndarray]:
    """Variance a component and (m,) weights: t, or normal for the rows that belong, whichever is likelier."""
    variance, weight = _t_scale(squares, count, used)
    kept = weight >= OUTLIER_WEIGHT
    free = max(float(count[kept].sum()) - used, 0.1 * float(count[kept].sum()), 1.0)
    plain = max(float(squares[kept].sum()) / free, _FINEST**2)
    normal = -0.5 * float(squares[kept].sum() / plain + count[kept].sum() * np.log(plain))
    size = squares[kept] / variance
    heavy = -float(
        np.sum(
            0.5 * (ROBUST_DOF + count[kept]) * np.log1p(size / ROBUST_DOF)
            + 0.5 * count[kept] * np.log(variance)
        )
    ) + float(np.sum(_t_constant(count[kept])))
    if normal >= heavy:
        return plain, np.where(kept, 1.0, ALMOST)
    return variance, np.where(kept, weight, ALMOST)


def _t_constant(count: np.ndarray) -> np.ndarray:
    """Normalisation of the multivariate t beyond that of the normal, a row [nats]."""
    from scipy.special import gammaln

    nu = ROBUST_DOF
    return gammaln(0.5 * (nu + count)) - gammaln(0.5 * nu) - 0.5 * count * np.log(0.5 * nu)


def _t_scale(squares: np.ndarray, count: np.ndarray, used: float) -> tuple[float, np.ndarray]:
    """Variance and weights by expectation maximisation of a multivariate t."""
    k = int(np.median(count))
    median = _MEDIAN.get(k, 1.0 - 2.0 / (9.0 * max(k, 1)))
    variance = max(float(np.median(squares / np.maximum(count, 1))) / median, _FINEST**2)
    free = max(float(count.sum()) - used, 0.1 * float(count.sum()), 1.0)
    weight = np.ones(len(squares))
    for _ in range(30):
        weight = (ROBUST_DOF + count) / (ROBUST_DOF + squares / variance)
        variance = max(float(weight @ squares) / free, _FINEST**2)
    relative = weight / ((ROBUST_DOF + count) / ROBUST_DOF)
    return variance, np.minimum(1.0, HEADROOM * relative)
