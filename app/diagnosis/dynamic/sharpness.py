"""How dry friction turns over when the motion does: at once, over a speed or over a way, joint by joint.

Each turn that is tried is fitted beside all masses, viscous friction, offset, rotor and rests of its joint; the one
that leaves least is taken, if it leaves plainly less than the usual one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.thresholds.friction import BLUNT, FINER, MEMORY, SLIPS, STRIBECK, SURE, TOGETHER, WIDER
from app.kinematics.dynamics import PER_LINK

if TYPE_CHECKING:
    from app.diagnosis.models.dynamic.samples import Samples

Turn = tuple[float, float]  # width [rad/s or m/s], slip [rad or m]


def learnt_turns(samples: Samples, before: Mapping[int, Turn]) -> tuple[np.ndarray, np.ndarray]:
    """(n,) speed [rad/s] at which dry friction has reached 76% of its level, and (n,) way [rad] over which it turns.

    The way is 0 where friction follows the speed alone.

    Args:
        before: joint (from 0) -> what another log of the arm told; friction turns as it did then.
    """
    state = samples.state
    width, slip = state.width.copy(), state.slip.copy()
    for j in range(state.joints):
        if j in before:
            width[j], slip[j] = before[j]
        elif state.moves(j):
            width[j], slip[j] = _learnt(samples, j)
    return width, slip


def _learnt(samples: Samples, j: int) -> Turn:
    """The turn of one joint."""
    state, usual = samples.state, float(samples.state.width[j])
    measured, fixed = samples.y[:, j] - samples.description[:, j], _fixed(samples, j)
    rho = _memory(measured, np.column_stack([fixed, state.direction(j)]))
    basis = _basis(_steps(fixed, rho))
    y = _steps(measured, rho)
    y = y - basis @ (basis.T @ y)
    rows = len(y)
    scores: dict[Turn, float] = {}

    def score(turn: Turn) -> float:
        if turn not in scores:
            sign = state.direction(j, *turn)
            fades = [share * state.speed[j] for share in STRIBECK if share * state.speed[j] > BLUNT * turn[0]]
            fading = [sign * np.exp(-((state.qd[:, j] / speed) ** 2)) for speed in fades]
            columns = _steps(np.column_stack([sign, *fading]), rho)
            left = _left(columns - basis @ (basis.T @ columns), y)
            scores[turn] = -rows / TOGETHER / 2.0 * float(np.log(np.mean(left**2) + 1e-300))
        return scores[turn]

    first = (usual, 0.0)
    blunt = [usual * wider for wider in WIDER if usual * wider <= 0.3 * state.speed[j]]
    reach = float(np.ptp(state.q[:, j]))
    tried: list[Turn] = [(width, 0.0) for width in blunt]
    tried += [(usual, share * reach) for share in SLIPS]
    best = max([first, *tried], key=score)
    if score(best) - SURE <= score(first):
        return first
    for step in FINER:  # between those that were tried
        best = max([_times(best, 1.0 / step), best, _times(best, step)], key=score)
    low, middle, high = (score(_times(best, factor)) for factor in (1.0 / FINER[-1], 1.0, FINER[-1]))
    if low + high < 2.0 * middle:  # the top of the parabola through the last three
        top = _times(best, FINER[-1] ** (0.5 * (high - low) / (2.0 * middle - low - high)))
        best = max([best, top], key=score)
    return best


def _times(turn: Turn, factor: float) -> Turn:
    """A turn over so many times the way, or the speed."""
    width, slip = turn
    return (width, slip * factor) if slip else (width * factor, 0.0)


def _steps(values: np.ndarray, rho: float) -> np.ndarray:
    """(M - 1, ...) of (M, ...): what is new in each row, of noise that keeps the share `rho` of the row before."""
    return values[1:] - rho * values[:-1]


def _memory(y: np.ndarray, columns: np.ndarray) -> float:
    """Share of the row before that what a first fit leaves keeps, from 0 on."""
    basis = _basis(columns)
    left = y - basis @ (basis.T @ y)
    return float(np.clip(left[1:] @ left[:-1] / max(float(left @ left), 1e-300), 0.0, MEMORY))


def _fixed(samples: Samples, j: int) -> np.ndarray:
    """(M, p) what every joint has beside dry friction, and its rests."""
    state, still = samples.state, [law for law in laws().values() if law.standstill]
    qd = state.qd[:, j]
    own = [np.ones(len(qd)), qd, qd * np.abs(qd), state.qdd[:, j]]
    rests = [
        law.columns(state, place)[j][:, 0]
        for law in still
        for place in law.places(state)
        if place.where["joint"] == j + 1
    ]
    return np.hstack([state.regressor[:, j, PER_LINK * j :], np.stack([*own, *rests], axis=1)])


def _basis(fixed: np.ndarray) -> np.ndarray:
    """(M, r) orthonormal, spanning columns (M, p)."""
    size = np.sqrt(np.mean(fixed**2, axis=0))
    fixed = fixed[:, size > 1e-12] / size[size > 1e-12]
    values, vectors = np.linalg.eigh(fixed.T @ fixed)
    good = values > 1e-6 * len(fixed)
    return fixed @ (vectors[:, good] / np.sqrt(values[good]))


def _left(columns: np.ndarray, y: np.ndarray) -> np.ndarray:
    """(M,) what a fit leaves; later columns against the dry friction of the first are no Stribeck friction."""
    gram, right = columns.T @ columns, columns.T @ y
    gram[np.diag_indices_from(gram)] += 1e-6 * len(y)
    kept = np.arange(columns.shape[1])
    weights = np.zeros(0)
    for _ in range(columns.shape[1]):
        weights = np.linalg.solve(gram[np.ix_(kept, kept)], right[kept])
        against = kept[1:][weights[1:] * weights[0] < 0]
        if not len(against):
            break
        kept = kept[~np.isin(kept, against)]
    return y - columns[:, kept] @ weights
