"""The arm's base, or the instrument, wanders."""

from __future__ import annotations

from app.diagnosis.static.body import base_columns, displaced_base, size
from app.diagnosis.static.effect import Place, Quantity, StaticEffect
from app.diagnosis.static.pace import pace, paces, per_unit


class BaseDrift(StaticEffect):
    key = "base_drift"
    title = "The base wanders"
    equation = "T_instrument_base moves by rate * (t - t0)"
    rank = 36
    curve = "pace"

    def places(self, situation):
        for driver in paces(situation):
            for turning in (0.0, 1.0):
                yield Place({"body": "base", "driver": driver}, {"turning": turning})

    def quantities(self, situation, place):
        per = per_unit(situation, place)
        shift = tuple(Quantity(f"v{c}", "mm" + per) for c in "xyz")
        turn = tuple(Quantity(f"w{c}", "deg" + per) for c in "xyz")
        return shift + turn if place.fixed["turning"] else shift

    def apply(self, cell, situation, place, values):
        return displaced_base(cell, values, pace(situation, place))

    def columns(self, columns, place):
        driver = pace(columns.situation, place)[:, None, None]
        return base_columns(columns, bool(place.fixed["turning"])) * driver

    def sentence(self, place, parameters):
        return f"The base wanders with {place.where['driver']} by {size(parameters)}."


EFFECT = BaseDrift()
