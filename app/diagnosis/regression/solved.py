"""What solving the evidence of a selection gives, and what it is asked of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np


class Statistics(Protocol):
    """What evidence needs of a problem: Gram matrix, right-hand side, sum of squares, degrees of freedom."""

    matrix: np.ndarray
    right: np.ndarray
    total: float
    dof: int


@dataclass(frozen=True, eq=False)
class Factor:
    """A selection factorised: M = G + Gamma^-1 = L L'.

    Args:
        columns: (a,) numbers of the columns in.
        lower: (a, a) L.
        solved: (a,) L^-1 X'y.
        residual: penalised residual R.
        occam: 1/2 ln |I + Gamma G|.
    """

    columns: np.ndarray
    lower: np.ndarray
    solved: np.ndarray
    residual: float
    occam: float


@dataclass(frozen=True, eq=False)
class Weights:
    """Weights of columns that were solved for.

    Args:
        columns: (a,) numbers of the columns in the design.
        weights: (a,) means, in nominal sizes.
        covariance: (a, a), noise variance included.
    """

    columns: np.ndarray
    weights: np.ndarray
    covariance: np.ndarray

    def of(self, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Means and covariance of some of the columns."""
        at = {int(c): i for i, c in enumerate(self.columns)}
        where = np.array([at[int(c)] for c in columns], int)
        return self.weights[where], self.covariance[np.ix_(where, where)]


@dataclass(frozen=True, eq=False)
class Posterior(Weights):
    """Weights of a selection.

    Args:
        variance: noise variance (1 where the noise is known).
    """

    variance: float


@dataclass(frozen=True, eq=False)
class Beside:
    """All columns beside a selection.

    Args:
        residual: penalised residual of the selection.
        right: (p,) what is left of X'y.
        cross: (a, p) L^-1 G: with its square taken off, what is left of the Gram matrix.
        back: (d, p) where a group was left out again: its square comes back.
    """

    residual: float
    right: np.ndarray
    cross: np.ndarray
    back: np.ndarray | None = None
