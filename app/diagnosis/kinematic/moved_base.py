"""A base that was moved so far in mid-recording that nothing near the description tells of it.

Beyond some millimetres, or a degree, a step of the base is not linear: columns worked out where it has not been found
point elsewhere, and the search takes other laws for what they leave. So rows before and after a row are looked at as
two set-ups of one arm, which is exact at any size; where that is likelier, the search starts with the step in place.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.models.kinematic.candidates import Candidate, Library
from app.diagnosis.models.kinematic.library import terms_from
from app.diagnosis.models.kinematic.rows import compared, t_likelihood, weighted_anew
from app.diagnosis.models.kinematic.state import State, settled, state_of
from app.diagnosis.thresholds.conventions import CONVENTION_MISFIT
from app.diagnosis.thresholds.evidence import STEP
from app.diagnosis.thresholds.rows import LEAST_ROWS
from app.geometry import log_so3

#: Rows tried first, spread over the recording; then those around the best, ever closer.
_TRIED = 16
#: Gauss-Newton steps of a set-up that is only compared.
_STEPS = 3


def with_moved_base(plain: State, rows: np.ndarray, library: Library) -> tuple[State, np.ndarray]:
    """The state with the base moved at the likeliest row, where two set-ups are the likelier description.

    Two set-ups have a base and a tool more, and the choice of the row: what they gain must pay for these (Schwarz's
    half a log of the rows each).

    Args:
        plain: base and tool fitted, nothing else.
        rows: (m,) weights of the rows there.
        library: what can happen; the step joins it.

    Returns:
        the state, with the step as its only term, and its rows' weights; both unchanged where nothing of the kind
        happened, or where the recording cannot tell.
    """
    recording = plain.recording
    kinds = [c for c in library.scanned if c.effect.moves_base]
    if (
        recording.mode == "targets"
        or recording.session_count > 1
        or not kinds
        or plain.misfit < CONVENTION_MISFIT
    ):
        return plain, rows
    row, apart = _likeliest(plain)
    if apart is None:
        return plain, rows
    kind = max(kinds, key=lambda c: len(c.widths))
    more = (3 if recording.mode == "length" else 6) + 3 * recording.reflectors
    gain = t_likelihood(recording, apart.residual, 0.0) - t_likelihood(recording, plain.residual, 0.0)
    if gain < STEP + (1.0 + 0.5 * more) * np.log(recording.size):
        return plain, rows
    candidate = library.at_row(kind, int(recording.situation.order[row]))
    moved = _moved(plain, apart, candidate, library)
    weights, rows = weighted_anew(moved, 0)
    return settled(replace(moved, weights=weights)), rows


def _likeliest(plain: State) -> tuple[int, State | None]:
    """The first row of the second set-up, and both fitted; None where no row leaves enough on either side."""
    recording = plain.recording
    first, last = LEAST_ROWS, recording.size - LEAST_ROWS
    if last < first:
        return 0, None
    tried: dict[int, tuple[float, State | None]] = {}
    step = max((last - first) // _TRIED, 1)
    rows = range(first, last + 1, step)
    while True:
        for row in rows:
            if row not in tried:
                apart = _apart(plain, row)
                tried[row] = (
                    -np.inf if apart is None else t_likelihood(recording, apart.residual, 0.0),
                    apart,
                )
        best = max(tried, key=lambda row: tried[row][0])
        if step == 1:
            return best, tried[best][1]
        step = max(step // 4, 1)
        rows = range(max(best - 4 * step, first), min(best + 4 * step, last) + 1, step)


def _apart(plain: State, row: int) -> State | None:
    """Rows before `row`, and from it on, each with a set-up of their own."""
    recording = plain.recording
    two = replace(recording, session=(np.arange(recording.size) >= row).astype(int))
    return compared(two, plain.held, _STEPS)


def _moved(plain: State, apart: State, candidate: Candidate, library: Library) -> State:
    """One set-up, that of the rows before, and the step from it to the one after."""
    setup = apart.setup
    towards = setup.rotations[0].T
    shift = towards @ (setup.positions[1] - setup.positions[0])
    turn = log_so3((towards @ setup.rotations[1])[None])[0]
    values = np.concatenate([shift, turn])[: len(candidate.widths)]
    number = library.number_of(candidate)
    terms = terms_from(library, {number: values / candidate.widths})
    one = replace(
        setup, rotations=setup.rotations[:1], positions=setup.positions[:1], tools=setup.tools[:1],
        mounts=setup.mounts[:1],
    )  # fmt: skip
    return settled(state_of(plain.recording, one, terms, plain.weights, held=plain.held))
