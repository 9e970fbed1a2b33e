"""How far off the unknowns may be where what is left over is not the noise it was whitened by.

A residual with structure hangs together over whole stretches of the log. What each stretch says against the
solution shows how the unknowns really vary from one to the next; where that is more than the noise explains,
it is the uncertainty.

Source: White (1980), Huber (1967), covariance from scores; stretches of time as in Newey, West (1987).
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.motion.scoring import Solution
from app.diagnosis.motion.system import System

STRETCHES = (1, 4)  # blocks that are taken together


def widening(system: System, solution: Solution, prior: np.ndarray) -> np.ndarray:
    """(p,) factors on the standard deviations of a solution's unknowns; 1 or more.

    Args:
        prior: (i, i) information on the leading unknowns.
    """
    size, blocks = len(solution.theta), system.block_count
    scores = np.zeros((size, blocks))
    found = system.block_scores(solution.theta, solution.columns, solution.positions)
    for u, col, pos in zip(found, solution.columns, solution.positions, strict=True):
        scores[pos] += u[:, col].T
    usual = np.maximum(np.diag(solution.covariance), 1e-300)
    by_prior = solution.covariance[:, : len(prior)]
    believed = np.einsum("ij,jk,ik->i", by_prior, prior, by_prior, optimize=True)
    widest = np.ones(size)
    for length in STRETCHES:
        edges = np.arange(0, blocks, length)
        moves = solution.covariance @ np.add.reduceat(scores, edges, axis=1)  # (p, stretches)
        # Scores of one fit add up to zero, as residuals do: a stretch fewer is free.
        seen = np.sum(moves**2, axis=1) * len(edges) / max(len(edges) - 1, 1)
        widest = np.maximum(widest, np.sqrt((seen + believed) / usual))
    return widest
