"""A joint's zero wanders with time or temperature."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    angle_unit,
    joint_driver,
    joint_name,
    joints,
)
from app.diagnosis.models.kinematic.pace import pace, paces, per_unit
from app.diagnosis.quantity import quantity

#: rad over the whole recording: encoders and gears that warm up.
_WIDTH = 2e-4


class JointDrift(KinematicEffect):
    """q_true = q + rate (t - t0)."""

    key = "joint_drift"
    title = "A joint's zero wanders"
    equation = "q_true = q + rate * (t - t0)"
    family = "events"
    level = Level.MECHANISM
    cap = 20.0
    lasting = False

    def places(self, situation):
        return [
            Place({"joint": j, "driver": driver}, member=False)
            for j in joints(situation)
            for driver in paces(situation)
        ]

    def quantities(self, situation, place):
        unit = angle_unit(situation, place.where["joint"], per_unit(situation, place))
        return (Quantity("rate", unit, _WIDTH / max(float(np.ptp(pace(situation, place))), 1e-12)),)

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, values[0] * pace(situation, place))

    def columns(self, columns, place):
        return joint_driver(columns, place.where["joint"], pace(columns.situation, place))

    def sentence(self, place, parameters):
        return f"The zero of {joint_name(place)} wanders with {place.where['driver']}: {quantity(parameters[0])}."


EFFECT = JointDrift()
