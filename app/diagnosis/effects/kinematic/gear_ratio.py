"""A joint turns a little more or less than it shows."""

from __future__ import annotations

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    joint_driver,
    joint_name,
    moving,
)
from app.diagnosis.quantity import quantity

#: relative: belts, and ratios rounded in a controller's tables.
_WIDTH = 3e-4


class GearRatio(KinematicEffect):
    """The controller divides by another ratio than the gear has: q_true = q (1 + ratio_error)."""

    key = "gear_ratio"
    title = "Wrong gear ratio"
    equation = "q_true = q * (1 + ratio_error)"
    family = "gears"
    located_by = ("joint",)
    level = Level.MECHANISM
    cap = 6.0  # 2 mrad a radian: a tooth more or less is far beyond, and a convention
    whole = True
    always = True

    def places(self, situation):
        return [Place({"joint": j, "driver": "own_angle"}) for j in moving(situation)]

    def quantities(self, situation, place):
        return (Quantity("ratio_error", "1", _WIDTH),)

    def apply(self, cell, situation, place, values):
        j = place.where["joint"] - 1
        return cell.add_joint(j, values[0] * situation.q[:, j])

    def columns(self, columns, place):
        j = place.where["joint"]
        return joint_driver(columns, j, columns.situation.q[:, j - 1])

    def sentence(self, place, parameters):
        return (
            f"{joint_name(place).capitalize()} turns by {quantity(parameters[0])} times its angle too much."
        )


EFFECT = GearRatio()
