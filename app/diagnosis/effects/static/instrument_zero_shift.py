"""The instrument's range or length has a wrong zero."""

from __future__ import annotations

from dataclasses import replace

from app.diagnosis.static.effect import Place, Quantity, StaticEffect, masked, number, since


class InstrumentZeroShift(StaticEffect):
    key = "instrument_zero_shift"
    title = "The instrument's range has a wrong zero"
    equation = "range_measured = range + offset"
    rank = 15

    def places(self, situation):
        return [Place({"body": "instrument"}), Place({"body": "instrument"}, scan=True)]

    def quantities(self, situation, place):
        return (Quantity("offset", "mm"),)

    def apply(self, cell, situation, place, values):
        return replace(cell, zero=cell.zero + values[0] * since(situation, place))

    def columns(self, columns, place):
        return masked(columns.zero[:, :, None], columns.situation, place)

    def sentence(self, place, parameters):
        since_row = f" from row {place.where['from_row']} on" if "from_row" in place.where else ""
        return f"The instrument reads ranges too long by {number(parameters[0])}{since_row}."


EFFECT = InstrumentZeroShift()
