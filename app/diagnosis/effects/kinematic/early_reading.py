"""The angles were read before the arm had stopped: each joint still had a share of its last move before it."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity
from app.diagnosis.quantity import quantity
from app.diagnosis.thresholds.evidence import LAW

#: relative: settling of servo loops a fraction of a second after a move.
_WIDTH = 1e-3


class EarlyReading(KinematicEffect):
    """q_true = q + share (q - q of the row before), in every joint at once."""

    key = "early_reading"
    title = "The angles were read before the arm had stopped"
    equation = "q_true = q + share * (q - q of the row before), every joint"
    family = "play"
    level = Level.MECHANISM
    cap = 100.0
    penalty = LAW + 2.0  # far rarer than what arms have, and close to play in every joint
    lasting = False

    def places(self, situation):
        stops = situation.move.any() and not situation.speed.any()  # in motion it is a delay
        return [Place({"body": "instrument", "driver": "approach"})] if stops else []

    def quantities(self, situation, place):
        return (Quantity("share", "1", _WIDTH, 0.0, 1.0),)

    def apply(self, cell, situation, place, values):
        for joint in range(situation.joint_count):
            cell = cell.add_joint(joint, values[0] * situation.move[:, joint])
        return cell

    def columns(self, columns, place):
        return np.einsum("mkj,mj->mk", columns.joint, columns.situation.move)[:, :, None]

    def sentence(self, place, parameters):
        return (
            f"Every joint ends {quantity(parameters[0])} of its last move beyond the angle recorded: the angles "
            f"were read before the arm had stopped."
        )


EFFECT = EarlyReading()
