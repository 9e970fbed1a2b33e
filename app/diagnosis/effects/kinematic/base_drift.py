"""The arm's base, or the instrument, wanders."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity
from app.diagnosis.models.kinematic.body import base_columns, displaced_base, size
from app.diagnosis.models.kinematic.pace import pace, paces, per_unit

#: m and rad over the whole recording: stands and floors.
_WIDTH = 2e-4


class BaseDrift(KinematicEffect):
    """T_instrument_base moves in proportion to time (or temperature), with or without a turn."""

    key = "base_drift"
    title = "The base wanders"
    equation = "T_instrument_base moves by rate * (t - t0)"
    family = "events"
    level = Level.MECHANISM
    cap = 30.0
    lasting = False

    def places(self, situation):
        for driver in paces(situation):
            for turning in (0.0, 1.0):
                yield Place({"body": "base", "driver": driver}, {"turning": turning}, member=False)

    def quantities(self, situation, place):
        per, reach = per_unit(situation, place), max(float(np.ptp(pace(situation, place))), 1e-12)
        shift = tuple(Quantity(f"v{c}", "mm" + per, _WIDTH / reach) for c in "xyz")
        turn = tuple(Quantity(f"w{c}", "deg" + per, _WIDTH / reach) for c in "xyz")
        return shift + turn if place.fixed["turning"] else shift

    def apply(self, cell, situation, place, values):
        return displaced_base(cell, values, pace(situation, place))

    def columns(self, columns, place):
        driver = pace(columns.situation, place)[:, None, None]
        return base_columns(columns, bool(place.fixed["turning"])) * driver

    def sentence(self, place, parameters):
        return f"The base wanders with {place.where['driver']} by {size(parameters)}."


EFFECT = BaseDrift()
