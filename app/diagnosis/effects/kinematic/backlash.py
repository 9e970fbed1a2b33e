"""A joint stops on either side of its play: by the direction it came from, or by the sign of its load."""

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
from app.diagnosis.quantity import quantity

#: rad: play of good gears, 0.7 arc minutes.
_WIDTH = 2e-4
#: Rows that must stand on either side of the play, at least: fewer would be outliers.
_EACH_SIDE = 3


class Backlash(KinematicEffect):
    """Teeth rest on one flank or the other: q_true = q - gap/2 sign. A negative gap is over-compensation.

    Source: Judd, Knasinski (1990); over-compensation: controllers add half the play in the direction of motion.
    """

    key = "backlash"
    title = "Play in a joint"
    equation = "q_true = q - gap/2 * sign(last move), or sign(torque)"
    family = "play"
    located_by = ("joint",)
    level = Level.MECHANISM
    cap = 30.0  # 6 mrad: a third of a degree, worn gears and hobby servos
    whole = True
    always = True

    def places(self, situation):
        for j in joints(situation):
            for driver in ("approach", "gravity_torque"):
                place = Place({"joint": j, "driver": driver})
                sign = _sign(situation, place)
                if min((sign > 0).sum(), (sign < 0).sum()) >= _EACH_SIDE:
                    yield place

    def quantities(self, situation, place):
        return (Quantity("gap", angle_unit(situation, place.where["joint"]), _WIDTH),)

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, -0.5 * values[0] * _sign(situation, place))

    def columns(self, columns, place):
        return joint_driver(columns, place.where["joint"], -0.5 * _sign(columns.situation, place))

    def sentence(self, place, parameters):
        how = "direction it came from" if place.where["driver"] == "approach" else "side gravity loads it on"
        if parameters[0].value < 0:
            what = f"The play of {joint_name(place)} is compensated {quantity(parameters[0])} too much"
        else:
            what = f"{joint_name(place).capitalize()} has play of {quantity(parameters[0])}"
        return f"{what}: where it stops depends on the {how}."


def _sign(situation, place) -> np.ndarray:
    j = place.where["joint"] - 1
    if place.where["driver"] == "approach":
        return situation.approach[:, j]
    return np.sign(situation.torque[:, j])


EFFECT = Backlash()
