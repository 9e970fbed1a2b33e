"""A joint's zero wanders with time or temperature."""

from __future__ import annotations

from app.diagnosis.static.effect import (
    Place,
    Quantity,
    StaticEffect,
    angle_unit,
    joint_driver,
    joint_name,
    joints,
    number,
)
from app.diagnosis.static.pace import pace, paces, per_unit


class JointDrift(StaticEffect):
    key = "joint_drift"
    title = "A joint's zero wanders"
    equation = "q_true = q + rate * (t - t0)"
    rank = 35
    curve = "pace"

    def places(self, situation):
        return [
            Place({"joint": j, "driver": driver}) for j in joints(situation) for driver in paces(situation)
        ]

    def quantities(self, situation, place):
        unit = angle_unit(situation, place.where["joint"], per_unit(situation, place))
        return (Quantity("rate", unit),)

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, values[0] * pace(situation, place))

    def columns(self, columns, place):
        return joint_driver(columns, place.where["joint"], pace(columns.situation, place))

    def sentence(self, place, parameters):
        return (
            f"The zero of {joint_name(place)} wanders with {place.where['driver']}: {number(parameters[0])}."
        )


EFFECT = JointDrift()
