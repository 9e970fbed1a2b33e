"""A joint stops on either side of its play: by the direction it came from, or by the sign of its load."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.effect import (
    Place,
    Quantity,
    StaticEffect,
    angle_unit,
    joint_driver,
    joint_name,
    joints,
    number,
)


class Backlash(StaticEffect):
    key = "backlash"
    title = "Play in a joint"
    equation = "q_true = q - gap/2 * sign(last move), or sign(torque)"
    rank = 20
    curve = "sign"

    def places(self, situation):
        for j in joints(situation):
            for driver in ("approach", "gravity_torque"):
                place = Place({"joint": j, "driver": driver})
                sign = _sign(situation, place)
                if min((sign > 0).sum(), (sign < 0).sum()) >= 2:  # both sides were taken
                    yield place

    def quantities(self, situation, place):
        return (Quantity("gap", angle_unit(situation, place.where["joint"]), lower=0.0),)

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, -0.5 * values[0] * _sign(situation, place))

    def columns(self, columns, place):
        return joint_driver(columns, place.where["joint"], -0.5 * _sign(columns.situation, place))

    def sentence(self, place, parameters):
        how = "direction it came from" if place.where["driver"] == "approach" else "side gravity loads it on"
        return f"{joint_name(place).capitalize()} has play of {number(parameters[0])}: it stops by the {how}."


def _sign(situation, place) -> np.ndarray:
    j = place.where["joint"] - 1
    if place.where["driver"] == "approach":
        return situation.approach[:, j]
    return np.sign(situation.torque[:, j])


EFFECT = Backlash()
