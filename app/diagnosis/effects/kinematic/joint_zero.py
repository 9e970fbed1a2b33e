"""A joint's zero is off by a constant."""

from __future__ import annotations

from app.diagnosis.effects.described import Placed, only
from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    angle_unit,
    joint_name,
    moving,
)
from app.diagnosis.quantity import quantity

#: rad (or m): zeros of arms as they leave the works.
_WIDTH = 1e-3


class JointZero(KinematicEffect):
    """The encoder was mastered at another angle than the description's zero: q_true = q + offset.

    The first joint's is the same as a turned base, the last one's the same as a turned tool, and that of a joint that
    never moves is the same as another arm beyond it: nothing can be said of it.
    Source: Mooring, Roth, Driels, "Fundamentals of Manipulator Calibration" (1991), ch. 2.
    """

    key = "joint_zero"
    title = "Joint zero is off"
    equation = "q_true = q + offset"
    family = "zeros"
    located_by = ("joint",)
    cap = 30.0
    whole = True
    always = True
    built = True

    def places(self, situation):
        return [Place({"joint": j}) for j in moving(situation)]

    def quantities(self, situation, place):
        return (Quantity("offset", angle_unit(situation, place.where["joint"]), _WIDTH),)

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, values[0])

    def columns(self, columns, place):
        return columns.joint[:, :, place.where["joint"] - 1, None]

    def described(self, robot, where, parameters):
        k = int(where["joint"])
        axis = robot.chain.axes[k - 1] * only(parameters)
        return (Placed(k, shift=axis) if robot.joints[k - 1].prismatic else Placed(k, turn=axis),)

    def sentence(self, place, parameters):
        return f"The zero of {joint_name(place)} is off by {quantity(parameters[0])}."


EFFECT = JointZero()
