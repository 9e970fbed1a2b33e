"""Base, tool and targets only: what the description alone says of a recording."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.cell import pose
from app.diagnosis.static.fit import Fitted, Term, apply_terms, fit
from app.diagnosis.static.noise import starting_weights, weights_from
from app.diagnosis.static.nuisance import starting_setup
from app.diagnosis.static.recording import StaticRecording


def plain_fit(recording: StaticRecording, held: tuple[Term, ...], *, quick: bool = False) -> Fitted:
    """The fit without any finding.

    Args:
        held: effects known already.
        quick: a few steps only, to compare gross misfits.
    """
    situation = recording.situation
    posed = pose(situation, apply_terms(situation, held), np.zeros((recording.reflectors, 3)))
    setup = starting_setup(recording, posed.hand, posed.frames.flange_positions)
    steps = 4 if quick else 30
    first = fit(recording, setup, (), starting_weights(recording), held=held, iterations=steps)
    if quick:
        return first
    return fit(recording, first.setup, (), weights_from(first), held=held)
