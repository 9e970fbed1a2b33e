"""Noise of each joint from what no law and no curve explains."""

from __future__ import annotations

import numpy as np

from app.diagnosis.motion.sampling import Samples
from app.diagnosis.motion.system import Group
from app.diagnosis.motion.whitening import Whitener, estimate, weights
from app.kinematics import RobotModel
from app.kinematics.dynamics import PER_LINK, inertial_parameters
from app.kinematics.regressor import torque_regressor

_RIDGE = 1e-9
POSES = 40  # at which the arm's inertia is looked at
DIRECTIONS = 32  # random mixtures that stand for all that was fitted
LEAST_PAIRS = 200  # rows seen twice, of which a noise can be learnt
_LOUD = 3.0  # times the usual variance of a block: something happened there


def whiteners_of(
    samples: Samples,
    shared: list[tuple[Group, np.ndarray]],
    local: list[list[tuple[Group, np.ndarray]]],
    extra: list[tuple[Group, np.ndarray]] = [],  # noqa: B006  (never written to)
) -> list[Whitener]:
    """One whitener a joint, from the residual of everything at once.

    Args:
        shared, local: all laws and curves.
        extra: groups that were found and are in neither (windows).
    """
    return [_whitener(samples, shared, local[j], extra, j) for j in range(samples.y.shape[1])]


def noise_of_motion(robot: RobotModel, samples: Samples) -> np.ndarray:
    """(n,) [Nm] what the errors left on the accelerations do to the description's torques."""
    state, n = samples.state, samples.state.joints
    some = np.unique(np.linspace(0, len(state.t) - 1, POSES).astype(int))
    q, still = state.q[some], np.zeros((len(some), n))
    nominal = inertial_parameters(robot)
    resting = torque_regressor(robot, q, still, still) @ nominal
    variance = np.zeros(n)
    for k, sigma in enumerate(samples.smoothing.acceleration):
        pushed = still.copy()
        pushed[:, k] = 1.0
        inertia = torque_regressor(robot, q, still, pushed) @ nominal - resting
        variance += sigma**2 * np.mean(inertia**2, axis=0)
    return np.sqrt(variance)


def _whitener(samples: Samples, shared, local, extra, j: int) -> Whitener:
    usable = samples.usable[:, j]
    if not usable.any():
        return estimate(samples.y[:, j], usable, samples.runs, np.zeros((len(usable), 1)))
    pieces = [samples.regressor[:, PER_LINK * j :, j]]
    pieces += [v[:, j] for g, v in shared if not g.base]
    pieces += [v for _, v in local]
    pieces += [v[:, j] if g.joint is None else v for g, v in extra if g.joint in (None, j)]
    columns = np.concatenate([p.T for p in pieces])
    y = samples.y[:, j]
    quiet = usable.copy()
    residual, taken = _left(columns, y, quiet)
    variance = np.array([np.mean(residual[r] ** 2) if len(r) else np.nan for r in _rows(samples, usable)])
    loud = variance > _LOUD * np.nanmedian(variance)
    if loud.any() and loud.mean() < 0.5:
        quiet &= ~loud[samples.blocks]
        residual, taken = _left(columns, y, quiet)
    fitted = _of_runs(samples, residual, quiet, taken) or estimate(residual, quiet, samples.runs, taken)
    # The loud blocks count again in the search: only the noise was not learnt from them.
    lags = len(fitted.lags)
    return Whitener(fitted.lags, fitted.sigma, weights(usable, samples.runs, lags))


def _of_runs(samples: Samples, residual: np.ndarray, quiet: np.ndarray, taken: np.ndarray) -> Whitener | None:
    """From what differs between two runs of one trajectory, where there are two and they agree the better."""
    lag = samples.repeat
    if not lag or np.count_nonzero(both := quiet[lag:] & quiet[:-lag]) < LEAST_PAIRS:
        return None
    differs = (residual[lag:] - residual[:-lag]) / np.sqrt(2.0)
    # Where the second run is not as the first (a load was taken up between), nothing is learnt from the pair.
    if np.mean(differs[both] ** 2) > np.mean(residual[quiet] ** 2):
        return None
    # Most of what the fit took is the same in both runs, and no part of their difference.
    apart = (taken[lag:] - taken[:-lag]) / np.sqrt(2.0)
    return estimate(differs, both, [slice(0, len(differs))], apart)


def _rows(samples: Samples, usable: np.ndarray) -> list[np.ndarray]:
    return [np.flatnonzero(usable & (samples.blocks == b)) for b in range(samples.block_count)]


def _left(columns: np.ndarray, y: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Residual on all rows of a ridge fit on `rows`, and directions (M, DIRECTIONS) that stand for its hat matrix.

    Products of rows of the orthonormal basis are, in mean, those of a few random mixtures of it (Hutchinson 1989).

    Args:
        columns: (k, M), each next to itself in memory.
        y: (M,).
        rows: (M,) True where a row counts.
    """
    part = columns * rows
    gram, right = part @ part.T, part @ y
    scale = np.sqrt(np.diag(gram))
    used = np.flatnonzero(scale > 1e-12 * np.sqrt(np.count_nonzero(rows)))
    scale = scale[used]
    values, vectors = np.linalg.eigh(gram[used[:, None], used] / scale / scale[:, None])
    keep = values > _RIDGE * values[-1]
    basis = np.zeros((len(columns), np.count_nonzero(keep)))
    basis[used] = vectors[:, keep] / np.sqrt(values[keep]) / scale[:, None]
    mixed = np.random.default_rng(0).normal(size=(basis.shape[1], DIRECTIONS))
    mixed *= np.sqrt(len(mixed)) / np.linalg.norm(mixed)  # so that as many are taken as were fitted
    return y - (basis @ (basis.T @ right)) @ columns, ((basis @ mixed).T @ columns).T
