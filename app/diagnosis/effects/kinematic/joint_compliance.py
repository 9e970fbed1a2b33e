"""A joint gives way under the torque that holds the arm."""

from __future__ import annotations

from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    joint_driver,
    joint_name,
    moving,
    nominal_compliance,
)
from app.diagnosis.quantity import quantity

#: Share of the largest load below which a joint carries nothing that could wind it up: it would have to be a hundred
#: times as soft to be seen, and what sensors show there is their own noise.
_FELT = 1e-2


class JointCompliance(KinematicEffect):
    """Gears and bearings wind up in proportion to the load: q_true = q - compliance * torque.

    A joint that never moves is left out: what it gives way cannot be told from its neighbours' wind-up.
    Torques are the recorded ones, else those of the description's masses, else of lumped masses.
    Source: Judd, Knasinski, "A technique to calibrate industrial robots" (1990).
    """

    key = "joint_compliance"
    title = "Joint gives way under gravity"
    equation = "q_true = q - compliance * torque"
    family = "elasticity"
    located_by = ("joint",)
    group = "give"
    cap = 50.0
    whole = True
    always = True

    def places(self, situation):
        largest = max(situation.torque.std(axis=0).max(), 1e-12)
        return [
            Place({"joint": j, "driver": "gravity_torque"})
            for j in moving(situation)
            if situation.torque[:, j - 1].std() > _FELT * largest
        ]

    def quantities(self, situation, place):
        j = place.where["joint"] - 1
        unit = "mm/N" if situation.chain.prismatic[j] else "rad/Nm"
        return (Quantity("compliance", unit, nominal_compliance(situation, j + 1), lower=0.0),)

    def apply(self, cell, situation, place, values):
        j = place.where["joint"] - 1
        return cell.add_joint(j, -values[0] * situation.torque[:, j])

    def columns(self, columns, place):
        j = place.where["joint"]
        return joint_driver(columns, j, -columns.situation.torque[:, j - 1])

    def sentence(self, place, parameters):
        return f"{joint_name(place).capitalize()} gives way under gravity by {quantity(parameters[0])}."


EFFECT = JointCompliance()
