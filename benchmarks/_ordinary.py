"""The ordinary peer for joint logs: plain least squares of base inertial parameters and joint friction.

tau = Y(q, qd, qdd) pi + viscous qd + coulomb sign(qd) + offset (+ rotor qdd), one least-squares problem over all
joints by its minimum-norm solution, which is a choice of base parameters.

Source: Gautier, Khalil (1990), Direct calculation of minimum inertial parameters; Swevers et al. (2007), Dynamic model
identification for industrial robots, IEEE Control Systems Magazine 27(5).
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.models.dynamic.state import State

RANK = 1e-6  # of the largest singular value: below it a combination is none that motion shows


def columns(state: State, rotor: bool) -> np.ndarray:
    """(M, n, p) of one log."""
    M, n = state.q.shape
    extra = [state.qd, np.sign(state.qd), np.ones((M, n))] + ([state.qdd] if rotor else [])
    own = np.zeros((M, n, len(extra) * n))
    for k, values in enumerate(extra):
        own[:, np.arange(n), k * n + np.arange(n)] = values
    return np.concatenate([state.regressor, own], axis=2)


def fit(X: np.ndarray, y: np.ndarray) -> np.ndarray:
    """(p,) least squares of y (M, n) on X (M, n, p)."""
    X, y = X.reshape(-1, X.shape[2]), y.reshape(-1)
    size = np.sqrt(np.mean(X**2, axis=0))
    kept = size > 1e-12
    theta = np.zeros(X.shape[1])
    scaled = X[:, kept] / size[kept]
    values, vectors = np.linalg.eigh(scaled.T @ scaled)
    good = values > RANK**2 * values[-1]
    basis = vectors[:, good]
    theta[kept] = basis @ ((basis.T @ (scaled.T @ y)) / values[good]) / size[kept]
    return theta


def heldout(X: np.ndarray, y: np.ndarray, folds: np.ndarray) -> np.ndarray:
    """(M, n) residual of rows left out, fold by fold; folds (M,)."""
    left = np.empty_like(y)
    for k in np.unique(folds):
        out = folds == k
        left[out] = y[out] - X[out] @ fit(X[~out], y[~out])
    return left


def time_folds(count: int, blocks: int = 20, folds: int = 5) -> np.ndarray:
    """(M,) fold of each row: whole blocks of time in turn."""
    return (np.arange(count) * blocks // max(count, 1)) % folds
