"""A gear or encoder wheel runs out of centre, or a flexspline is oval: one or two waves a turn of the joint."""

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
    moving,
)

#: rad: run-out of encoder discs and transmission error of harmonic drives.
_WIDTH = 2e-4


class GearEccentricity(KinematicEffect):
    """An eccentric wheel makes one wave a turn, the oval of a harmonic drive two.

    Source: Kircanski, Goldenberg, "An experimental study of nonlinear stiffness, hysteresis, and friction effects in
    robot joints with harmonic drives" (1997) for two waves.
    """

    key = "gear_eccentricity"
    title = "A gear or encoder runs out of centre"
    equation = "q_true = q + sin * sin(order q) + cos * cos(order q)"
    family = "gears"
    located_by = ("joint",)
    level = Level.MECHANISM
    cap = 8.0  # 1.6 mrad: a disc 50 um out of centre under marks 30 mm from it
    whole = True
    always = True

    def places(self, situation):
        return [
            Place({"joint": j, "driver": "own_angle", "order": order})
            for j in moving(situation)
            if not situation.chain.prismatic[j - 1]
            for order in (1, 2)
        ]

    def quantities(self, situation, place):
        unit = angle_unit(situation, place.where["joint"])
        return tuple(Quantity(name, unit, _WIDTH) for name in ("sin", "cos"))

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, _waves(situation, place) @ values)

    def columns(self, columns, place):
        return joint_driver(columns, place.where["joint"], _waves(columns.situation, place))

    def sentence(self, place, parameters):
        size = np.hypot(parameters[0].value, parameters[1].value)
        if place.where.get("order", 1) == 2:
            how = "two waves a turn, as the oval of a harmonic drive makes"
        else:
            how = "one wave a turn, as an eccentric gear or encoder makes"
        return f"{joint_name(place).capitalize()} is off by {size:.3g} {parameters[0].unit} in {how}."


def _waves(situation, place) -> np.ndarray:
    angle = place.where.get("order", 1) * situation.q[:, place.where["joint"] - 1]
    return np.column_stack([np.sin(angle), np.cos(angle)])


EFFECT = GearEccentricity()
