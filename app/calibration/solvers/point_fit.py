"""What every estimator of the tool point gives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.errors import DegenerateGeometryError, TooFewPointsError

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
        touches = "1 touch" if count == 1 else f"{count} touches"
        raise TooFewPointsError(
            f"{touches} cannot determine a tool point: at least 3 are needed",
            rank=0 if count < 2 else 2,
            needed=3,
            advice="touch the same point again with the tool tilted another way",
            code="too_few",
        )


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
        if rank == 0:
            message = "all touches have the same orientation"
            advice = "tilt the tool between touches, about two different axes"
        else:
            message = "all touches turn about one axis"
            advice = "tilt the tool about another axis as well"
        along = "(" + ", ".join(f"{v:.2f}" for v in np.round(unseen, 2) + 0.0) + ")"
        raise DegenerateGeometryError(
            f"{message} ({along} in the flange): the tool point along it stays open",
            rank=rank,
            needed=3,
            unseen=along,
            advice=advice,
            code="one_axis",
        )
    return values, directions
