"""The tool, or one reflector of several, was knocked and sits elsewhere from a row on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

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
        each = range(1, situation.reflectors + 1) if situation.reflectors > 1 else ()
        return [
            Place({"body": "tool"}, scan=True),
            *(Place({"body": "tool", "reflector": r}, scan=True) for r in each),
        ]

    def quantities(self, situation, place):
        return tuple(Quantity(f"d{c}", "mm", _WIDTH) for c in "xyz")

    def apply(self, cell, situation, place, values):
        if "reflector" in place.where:
            if situation.reflectors == 1:  # another recording's reflectors are others
                return cell
            reflectors = cell.reflectors + 0.0 * since(situation, place)[:, None, None]
            reflectors[:, place.where["reflector"] - 1] += since(situation, place)[:, None] * values
            return replace(cell, reflectors=reflectors)
        tool = cell.tool + 0.0 * since(situation, place)[:, None]
        tool[:, :3] += since(situation, place)[:, None] * values
        return replace(cell, tool=tool)

    def columns(self, columns, place):
        moves = columns.tool[:, :, :3]
        if "reflector" in place.where:  # components: three a reflector, in their order, then the orientation
            own = np.arange(moves.shape[1]) // 3 == place.where["reflector"] - 1
            moves = np.where(own[:, None], moves, 0.0)
        return masked(moves, columns.situation, place)

    def sentence(self, place, parameters):
        what = f"reflector {place.where['reflector']}" if "reflector" in place.where else "the tool"
        return f"From row {place.where['from_row']} on {what} sits {size(parameters)} off in its flange."


EFFECT = ToolSlip()
