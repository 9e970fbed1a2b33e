"""The tip is pressed past the target before the touch is taken."""

from __future__ import annotations

from dataclasses import replace

from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity
from app.diagnosis.quantity import quantity

#: m: a tip pressed by hand.
_WIDTH = 3e-4


class TouchIndentation(KinematicEffect):
    """Along the flange's Z: the same as a longer tool wherever the tool is not known."""

    key = "touch_indentation"
    title = "The tip was pressed in"
    equation = "p_target = p_tip - depth * z_flange"
    family = "instrument"
    lasting = False

    def places(self, situation):
        return [Place({"body": "tool"})]

    def quantities(self, situation, place):
        return (Quantity("depth", "mm", _WIDTH, lower=0.0),)

    def apply(self, cell, situation, place, values):
        return replace(cell, press=cell.press + values[0])

    def columns(self, columns, place):
        return columns.press[:, :, None]

    def sentence(self, place, parameters):
        return f"The tip was pressed {quantity(parameters[0])} past the target."


EFFECT = TouchIndentation()
