"""What the description alone says: base, tool and touched points fitted, nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.models.kinematic.rows import first_weights, weighted_anew
from app.diagnosis.models.kinematic.state import State, settled, started
from app.diagnosis.models.kinematic.terms import Term
from app.diagnosis.observations.pose_data import StaticRecording


def plain_state(
    recording: StaticRecording, held: tuple[Term, ...], *, quick: bool = False
) -> tuple[State, np.ndarray]:
    """Base, tool and touched points fitted robustly with effects held, and the rows' weights.

    Args:
        quick: a few steps only, to compare gross misfits.
    """
    steps = 4 if quick else 20
    now = settled(started(recording, held, first_weights(recording)), steps)
    rows = np.ones(recording.size)
    for _ in range(2):
        weights, rows = weighted_anew(now, 0)
        now = settled(replace(now, weights=weights), steps)
    weights, rows = weighted_anew(now, 0)
    return replace(now, weights=weights), rows
