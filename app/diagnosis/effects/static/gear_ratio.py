"""A joint turns a little more or less than it shows."""

from __future__ import annotations

from app.diagnosis.static.effect import (
    Place,
    Quantity,
    StaticEffect,
    joint_driver,
    joint_name,
    joints,
    number,
)

#: More is another unit or another gear box.
LARGEST = 0.2


class GearRatio(StaticEffect):
    key = "gear_ratio"
    title = "Wrong gear ratio"
    equation = "q_true = q * (1 + ratio_error)"
    rank = 25
    curve = "own_angle"

    def places(self, situation):
        return [Place({"joint": j, "driver": "own_angle"}) for j in joints(situation)]

    def quantities(self, situation, place):
        return (Quantity("ratio_error", "1", -LARGEST, LARGEST),)

    def apply(self, cell, situation, place, values):
        j = place.where["joint"] - 1
        return cell.add_joint(j, values[0] * situation.q[:, j])

    def columns(self, columns, place):
        j = place.where["joint"]
        return joint_driver(columns, j, columns.situation.q[:, j - 1])

    def sentence(self, place, parameters):
        return f"{joint_name(place).capitalize()} turns by {number(parameters[0])} times its angle too much."


EFFECT = GearRatio()
