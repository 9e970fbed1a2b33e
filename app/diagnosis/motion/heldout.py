"""Error on blocks of time the model has not seen."""

from __future__ import annotations

import numpy as np

from app.diagnosis.motion.scoring import solve
from app.diagnosis.motion.system import Group, System

FOLDS = 5


def folds(blocks: int) -> list[np.ndarray]:
    """Blocks left out in turn: every fifth one, and runs of neighbours."""
    index = np.arange(blocks)
    interleaved = [index[index % FOLDS == k] for k in range(FOLDS)]
    runs = [index[index * FOLDS // blocks == k] for k in range(FOLDS)]
    return interleaved + runs


def heldout_losses(system: System, selected: list[Group], prior: np.ndarray) -> np.ndarray:
    """(2,) whitened sum of squares on what was left out, for interleaved blocks and for runs."""
    everything = np.arange(system.block_count)
    out = []
    for left_out in folds(system.block_count):
        kept = np.setdiff1d(everything, left_out)
        theta = solve(system, selected, prior, kept).theta
        A, g, yy = system.normal(selected, left_out)
        out.append(yy - 2 * float(g @ theta) + float(theta @ A @ theta))
    return np.array([sum(out[:FOLDS]), sum(out[FOLDS:])])
