"""The arm's base, or the instrument, was moved between two rows."""

from __future__ import annotations

from app.diagnosis.static.body import base_columns, displaced_base, size
from app.diagnosis.static.effect import Place, Quantity, StaticEffect, masked, since

#: m: what moves farther is another set-up, not a knock; without it steps imitate targets that were mixed up.
_FARTHEST = 0.1


class BaseShift(StaticEffect):
    key = "base_shift"
    title = "The base was moved"
    equation = "T_instrument_base steps at row k"
    rank = 21

    def places(self, situation):
        return [Place({"body": "base"}, {"turning": turning}, scan=True) for turning in (0.0, 1.0)]

    def quantities(self, situation, place):
        shift = tuple(Quantity(f"d{c}", "mm", lower=-_FARTHEST, upper=_FARTHEST) for c in "xyz")
        turn = tuple(Quantity(f"r{c}", "deg") for c in "xyz")
        return shift + turn if place.fixed["turning"] else shift

    def apply(self, cell, situation, place, values):
        return displaced_base(cell, values, since(situation, place))

    def columns(self, columns, place):
        return masked(base_columns(columns, bool(place.fixed["turning"])), columns.situation, place)

    def sentence(self, place, parameters):
        return f"From row {place.where['from_row']} on the base (or the instrument) stands {size(parameters)} off."


EFFECT = BaseShift()
