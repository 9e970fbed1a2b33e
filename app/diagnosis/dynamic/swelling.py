"""A contact that rises and falls as half a sine, as a push by hand does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.effects.effect import Place
from app.diagnosis.regression.evidence import Selection
from app.diagnosis.thresholds.events import SHORTEST

if TYPE_CHECKING:
    from app.diagnosis.dynamic.events import Events
    from app.diagnosis.effects.dynamic._law import Law

SWELLS = (1.0, 1.3)  # lengths of such a contact over that of the best even one
TRIALS = 40  # edges that are tried


def swelling(events: Events, selection: Selection, law: Law, even: Place) -> tuple[float, Place]:
    """The best swelling contact and its evidence beside a selection [nats], looked for around an even one."""
    from scipy.optimize import minimize

    first, last = even.where["from_s"], even.where["to_s"]
    middle, half, least = 0.5 * (first + last), 0.5 * (last - first), 0.5 * SHORTEST

    def place(ends: np.ndarray) -> Place:
        where = {"from_s": float(ends[0]), "to_s": float(max(ends[1], ends[0] + least))}
        return Place({**even.where, **where}, {"fixed_swell": 1.0}, cost=even.cost + 1.0)

    def worse(ends: np.ndarray) -> float:
        return -events.gain(selection, law, place(ends))

    start = min((np.array([middle - wider * half, middle + wider * half]) for wider in SWELLS), key=worse)
    simplex = start + 0.1 * half * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    found = minimize(
        worse, start, method="Nelder-Mead", options={"maxfev": TRIALS, "initial_simplex": simplex}
    )
    return float(-found.fun), place(found.x)
