"""A joint's zero jumped between two rows: a tooth, a brake, a lost count."""

from __future__ import annotations

from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    angle_unit,
    joint_name,
    joints,
    masked,
    since,
)
from app.diagnosis.quantity import quantity

#: rad (or m): lost counts are small, teeth are large.
_WIDTH = 5e-4


class JointSlip(KinematicEffect):
    """q_true = q + step from row k on."""

    key = "joint_slip"
    title = "A joint's zero jumped"
    equation = "q_true = q + step from row k on"
    family = "events"
    located_by = ("joint",)
    cap = 100.0
    lasting = False

    def places(self, situation):
        return [Place({"joint": j}, scan=True) for j in joints(situation)]

    def quantities(self, situation, place):
        return (Quantity("step", angle_unit(situation, place.where["joint"]), _WIDTH),)

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, values[0] * since(situation, place))

    def columns(self, columns, place):
        j = place.where["joint"] - 1
        return masked(columns.joint[:, :, j, None], columns.situation, place)

    def sentence(self, place, parameters):
        return (
            f"The zero of {joint_name(place)} jumped by {quantity(parameters[0])} "
            f"at row {place.where['from_row']}."
        )


EFFECT = JointSlip()
