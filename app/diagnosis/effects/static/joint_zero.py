"""A joint's zero is off by a constant."""

from __future__ import annotations

from app.diagnosis.static.effect import (
    Place,
    Quantity,
    StaticEffect,
    angle_unit,
    joint_name,
    joints,
    number,
)

#: rad or m: more is another convention, not a zero.
LARGEST = 0.5


class JointZero(StaticEffect):
    key = "joint_zero"
    title = "Joint zero is off"
    equation = "q_true = q + offset"
    rank = 0

    def places(self, situation):
        return [Place({"joint": j}) for j in joints(situation)]

    def quantities(self, situation, place):
        return (Quantity("offset", angle_unit(situation, place.where["joint"]), -LARGEST, LARGEST),)

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, values[0])

    def columns(self, columns, place):
        return columns.joint[:, :, place.where["joint"] - 1, None]

    def sentence(self, place, parameters):
        return f"The zero of {joint_name(place)} is off by {number(parameters[0])}."


EFFECT = JointZero()
