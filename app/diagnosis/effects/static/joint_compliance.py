"""A joint gives way under the torque that holds the arm."""

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


class JointCompliance(StaticEffect):
    key = "joint_compliance"
    title = "Joint gives way under gravity"
    equation = "q_true = q - compliance * torque"
    rank = 10
    curve = "gravity_torque"

    def places(self, situation):
        return [
            Place({"joint": j, "driver": "gravity_torque"})
            for j in joints(situation)
            if situation.torque[:, j - 1].std() > 0
        ]

    def quantities(self, situation, place):
        prismatic = situation.chain.prismatic[place.where["joint"] - 1]
        return (Quantity("compliance", "mm/N" if prismatic else "rad/Nm", lower=0.0),)

    def apply(self, cell, situation, place, values):
        j = place.where["joint"] - 1
        return cell.add_joint(j, -values[0] * situation.torque[:, j])

    def columns(self, columns, place):
        j = place.where["joint"]
        return joint_driver(columns, j, -columns.situation.torque[:, j - 1])

    def sentence(self, place, parameters):
        return f"{joint_name(place).capitalize()} gives way under gravity by {number(parameters[0])}."


EFFECT = JointCompliance()
