"""In motion, a measurement belongs to where the arm was a moment before its row: filters and stamps of two devices."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity
from app.diagnosis.quantity import quantity
from app.diagnosis.thresholds.conventions import MOST_APART

#: s: two clocks of a network, a filter of an instrument.
_WIDTH = 2e-3


class Delay(KinematicEffect):
    """q_true = q - delay * speed, in every joint at once; a delay of more than the joints go evenly is undone before
    anything is fitted, see kinematic/timing.py."""

    key = "delay"
    title = "The measurement and the angles are not of one moment"
    equation = "q_true(t) = q(t - delay), every joint"
    family = "instrument"
    cap = 100.0  # two tenths of a second: beyond, the arm no longer goes evenly

    def places(self, situation):
        return [Place({"body": "instrument", "driver": "speed"})] if situation.speed.any() else []

    def quantities(self, situation, place):
        return (Quantity("delay", "s", _WIDTH, -MOST_APART, MOST_APART),)

    def apply(self, cell, situation, place, values):
        for joint in range(situation.joint_count):
            cell = cell.add_joint(joint, -values[0] * situation.speed[:, joint])
        return cell

    def columns(self, columns, place):
        return -np.einsum("mkj,mj->mk", columns.joint, columns.situation.speed)[:, :, None]

    def sentence(self, place, parameters):
        return f"Each measurement is of where the arm was {quantity(parameters[0])} before its row."


EFFECT = Delay()
