"""The instrument measures too long or too short."""

from __future__ import annotations

from dataclasses import replace

from app.diagnosis.static.effect import Place, Quantity, StaticEffect, number

#: More is another unit.
LARGEST = 0.2


class InstrumentScale(StaticEffect):
    key = "instrument_scale"
    title = "The instrument's scale is off"
    equation = "measured = true * (1 + scale_error)"
    rank = 8

    def places(self, situation):
        return [Place({"body": "instrument"})]

    def quantities(self, situation, place):
        return (Quantity("scale_error", "1", -LARGEST, LARGEST),)

    def apply(self, cell, situation, place, values):
        return replace(cell, scale=cell.scale + values[0])

    def columns(self, columns, place):
        return columns.scale[:, :, None]

    def sentence(self, place, parameters):
        return f"The instrument's lengths are too long by {number(parameters[0])} of themselves."


EFFECT = InstrumentScale()
