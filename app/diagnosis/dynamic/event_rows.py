"""An event's edges moved by single rows, each trial weighed by what those rows change.

Sums over rows take what is whitened before it is cut; an edge that is cut before, as it is, may lie as many rows off as
the noise remembers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.diagnosis.dynamic.event_sums import block_gains
from app.diagnosis.dynamic.event_white import changed, sums_of
from app.diagnosis.effects.effect import Place

if TYPE_CHECKING:
    from app.diagnosis.dynamic.events import Events
    from app.diagnosis.effects.dynamic._law import Law
    from app.diagnosis.regression.evidence import Selection

ROWS = (-4, -3, -2, -1, 1, 2, 3, 4)  # by which an edge is moved: edges were tried four rows apart


def at_exact_rows(
    events: Events, selection: Selection, law: Law, place: Place, step: float
) -> tuple[float, Place]:
    """The most evidence beside a selection [nats], and the event with its edges there; rows are `step` apart [s]."""
    inverse, parts, residual = events.beside(selection)
    best = (events.gain(selection, law, place), place)
    for end in [end for end in (*law.ends, law.until) if end in place.where]:
        now = best[1]
        white, shape = events.white_parts(law, now), law.shape(events.state, now)
        sums = sums_of(white, parts, residual, len(inverse))
        for rows in ROWS:
            trial = Place({**now.where, end: place.where[end] + rows * step}, place.fixed, cost=place.cost)
            change = events.shaped(law, law.shape(events.state, trial) - shape)
            moved = changed(sums, white, change, parts, residual)
            gain = block_gains(moved.gram[None], moved.cross[None], moved.right[None], inverse)
            worth = float(gain[0]) - law.penalty - place.cost
            best = max(best, (worth, trial), key=lambda found: found[0])
    return best
