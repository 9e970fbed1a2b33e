"""The angles were read before the arm had stopped: each joint still had a share of its last move before it."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.effect import Place, Quantity, StaticEffect, number


class EarlyReading(StaticEffect):
    key = "early_reading"
    title = "The angles were read before the arm had stopped"
    equation = "q_true = q + share * (q - q of the row before), every joint"
    rank = 35

    def places(self, situation):
        return [Place({"body": "instrument", "driver": "approach"})] if situation.move.any() else []

    def quantities(self, situation, place):
        return (Quantity("share", "1", 0.0, 1.0),)

    def apply(self, cell, situation, place, values):
        for joint in range(situation.joint_count):
            cell = cell.add_joint(joint, values[0] * situation.move[:, joint])
        return cell

    def columns(self, columns, place):
        return np.einsum("mkj,mj->mk", columns.joint, columns.situation.move)[:, :, None]

    def sentence(self, place, parameters):
        return (
            f"Every joint ends {number(parameters[0])} of its last move beyond the angle recorded: the angles "
            f"were read before the arm had stopped."
        )


EFFECT = EarlyReading()
