"""The tool slipped in its flange between two rows."""

from __future__ import annotations

from dataclasses import replace

from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity, masked, since
from app.diagnosis.models.kinematic.body import size

#: m: a knock against a torch or a magnet nest.
_WIDTH = 5e-4


class ToolSlip(KinematicEffect):
    """p_flange_tool steps at row k."""

    key = "tool_slip"
    title = "The tool slipped"
    equation = "p_flange_tool steps at row k"
    family = "events"
    cap = 100.0
    lasting = False

    def places(self, situation):
        return [Place({"body": "tool"}, scan=True)]

    def quantities(self, situation, place):
        return tuple(Quantity(f"d{c}", "mm", _WIDTH) for c in "xyz")

    def apply(self, cell, situation, place, values):
        tool = cell.tool + 0.0 * since(situation, place)[:, None]
        tool[:, :3] += since(situation, place)[:, None] * values
        return replace(cell, tool=tool)

    def columns(self, columns, place):
        return masked(columns.tool[:, :, :3], columns.situation, place)

    def sentence(self, place, parameters):
        return f"From row {place.where['from_row']} on the tool sits {size(parameters)} off in its flange."


EFFECT = ToolSlip()
