"""The instrument measures too long or too short."""

from __future__ import annotations

from dataclasses import replace

from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity
from app.diagnosis.quantity import quantity

#: relative: air, temperature of scales and fixtures.
_WIDTH = 1e-4


class InstrumentScale(KinematicEffect):
    """measured = true (1 + scale_error); with all lengths free it is the same as every link being longer."""

    key = "instrument_scale"
    title = "The instrument's scale is off"
    equation = "measured = true * (1 + scale_error)"
    family = "instrument"
    cap = 5.0  # half a millimetre a metre: cameras; lasers are a hundred times better

    def places(self, situation):
        return [Place({"body": "instrument"})]

    def quantities(self, situation, place):
        return (Quantity("scale_error", "1", _WIDTH),)

    def apply(self, cell, situation, place, values):
        return replace(cell, scale=cell.scale + values[0])

    def columns(self, columns, place):
        return columns.scale[:, :, None]

    def sentence(self, place, parameters):
        return f"The instrument's lengths are too long by {quantity(parameters[0])} of themselves."


EFFECT = InstrumentScale()
