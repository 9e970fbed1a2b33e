"""The arm's base, or the instrument, was moved between two rows."""

from __future__ import annotations

from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity, masked, since
from app.diagnosis.models.kinematic.body import base_columns, displaced_base, size

#: m and rad: a knock against a tripod.
_WIDTH = 5e-4


class BaseShift(KinematicEffect):
    """T_instrument_base steps at row k, with or without a turn."""

    key = "base_shift"
    title = "The base was moved"
    equation = "T_instrument_base steps at row k"
    family = "events"
    cap = 2000.0  # 1 m, 1 rad: an instrument that is turned stands far off as the base sees it
    lasting = False
    moves_base = True

    def places(self, situation):
        return [Place({"body": "base"}, {"turning": turning}, scan=True) for turning in (0.0, 1.0)]

    def quantities(self, situation, place):
        shift = tuple(Quantity(f"d{c}", "mm", _WIDTH) for c in "xyz")
        turn = tuple(Quantity(f"r{c}", "deg", _WIDTH) for c in "xyz")
        return shift + turn if place.fixed["turning"] else shift

    def apply(self, cell, situation, place, values):
        return displaced_base(cell, values, since(situation, place))

    def columns(self, columns, place):
        return masked(base_columns(columns, bool(place.fixed["turning"])), columns.situation, place)

    def sentence(self, place, parameters):
        return f"From row {place.where['from_row']} on the base (or the instrument) stands {size(parameters)} off."


EFFECT = BaseShift()
