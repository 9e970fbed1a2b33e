"""The instrument's range or length has a wrong zero, throughout or from a row on."""

from __future__ import annotations

from dataclasses import replace

from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity, masked, since
from app.diagnosis.quantity import quantity

#: m: a wire that slipped on its drum; a tracker's range is off by the mount of its reflector at most.
_WIDTH_WIRE, _WIDTH_POINTS = 5e-3, 1e-4


class InstrumentZeroShift(KinematicEffect):
    """range_measured = range + offset."""

    key = "instrument_zero_shift"
    title = "The instrument's range has a wrong zero"
    equation = "range_measured = range + offset"
    family = "instrument"
    cap = 20.0

    def places(self, situation):
        if situation.instrument == "targets":
            return []
        return [Place({"body": "instrument"}), Place({"body": "instrument"}, scan=True)]

    def quantities(self, situation, place):
        wire = situation.instrument == "length"
        return (Quantity("offset", "mm", _WIDTH_WIRE if wire else _WIDTH_POINTS),)

    def apply(self, cell, situation, place, values):
        return replace(cell, zero=cell.zero + values[0] * since(situation, place))

    def columns(self, columns, place):
        return masked(columns.zero[:, :, None], columns.situation, place)

    def sentence(self, place, parameters):
        since_row = f" from row {place.where['from_row']} on" if "from_row" in place.where else ""
        return f"The instrument reads ranges too long by {quantity(parameters[0])}{since_row}."


EFFECT = InstrumentZeroShift()
