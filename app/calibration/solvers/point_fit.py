"""What every estimator of the tool point gives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.wording import degenerate
from app.errors import TooFewPointsError

#: Smallest angular spread [rad] of the touches about any axis that counts as a turn at all.
NO_TURN = 1e-6


@dataclass(frozen=True, eq=False)
class PointFit:
    """Tool point and touched point.

    Args:
        tool: (3,) in the flange [m].
        touched: (3,) in base [m].
        residuals: (n, 3) tip minus touched point, in base [m].
        gains: (n, 3, 3) how far the tool point moves for an error of each tip.
        condition: of the equations of the tool point.
        sigma: sqrt(SSE / (3 n - 6)) of the order-free fit [m].
        weights: (n,) what each touch counted.
    """

    tool: np.ndarray
    touched: np.ndarray
    residuals: np.ndarray
    gains: np.ndarray
    condition: float
    sigma: float
    weights: np.ndarray

    @property
    def unit_covariance(self) -> np.ndarray:
        """(3, 3) covariance of `tool` for independent tips with unit noise on each axis."""
        return np.einsum("nij,nkj->ik", self.gains, self.gains)

    @property
    def dof(self) -> int:
        return 3 * len(self.residuals) - 6


def refuse_too_few(count: int) -> None:
    """Raises TooFewPointsError below three touches: two leave the turn between them open."""
    if count < 3:
        key = "too_few_one" if count == 1 else "too_few"
        rank = 0 if count < 2 else 2
        raise degenerate("too_few", key, kind=TooFewPointsError, rank=rank, needed=3, count=count)


def refuse_one_axis(rotations: np.ndarray, least: float = NO_TURN) -> tuple[np.ndarray, np.ndarray]:
    """Refuses touches whose rotations all share one axis.

    Args:
        rotations: (n, 3, 3).
        least: angular spread [rad] below which a turn cannot be told from none (the rounding of the angles).

    Returns:
        singular values (3,) of the equations, largest first, and their directions (3, 3), one a row, in the flange.

    Raises:
        DegenerateGeometryError: the tool point along some direction of the flange leaves no trace.
    """
    centred = (rotations - rotations.mean(axis=0)).reshape(-1, 3)
    _, values, directions = np.linalg.svd(centred, full_matrices=False)
    spread = values / np.sqrt(len(rotations))  # rms length by which a unit lever moves
    rank = int((spread > max(least, NO_TURN)).sum())
    if rank < 3:
        unseen = directions[-1] * np.sign(directions[-1][np.argmax(np.abs(directions[-1]))])
        along = "(" + ", ".join(f"{v:.2f}" for v in np.round(unseen, 2) + 0.0) + ")"
        key = "same_orientation" if rank == 0 else "one_axis"
        raise degenerate("one_axis", key, rank=rank, needed=3, unseen=along, along=along)
    return values, directions
