"""A gear or encoder wheel runs out of centre: one wave a turn of the joint."""

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
)

#: rad: a gear that ran out by more could not turn.
_LARGEST = 0.2


class GearEccentricity(StaticEffect):
    key = "gear_eccentricity"
    title = "A gear or encoder runs out of centre"
    equation = "q_true = q + sin * sin(q) + cos * cos(q)"
    rank = 30
    curve = "own_angle"

    def places(self, situation):
        return [
            Place({"joint": j, "driver": "own_angle"})
            for j in joints(situation)
            if not situation.chain.prismatic[j - 1]
        ]

    def quantities(self, situation, place):
        unit = angle_unit(situation, place.where["joint"])
        return tuple(Quantity(name, unit, lower=-_LARGEST, upper=_LARGEST) for name in ("sin", "cos"))

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, _waves(situation, place) @ values)

    def columns(self, columns, place):
        return joint_driver(columns, place.where["joint"], _waves(columns.situation, place))

    def sentence(self, place, parameters):
        size = np.hypot(parameters[0].value, parameters[1].value)
        return (
            f"{joint_name(place).capitalize()} is off by a wave of {size:.3g} {parameters[0].unit} a turn, "
            f"as an eccentric gear or encoder makes."
        )


def _waves(situation, place) -> np.ndarray:
    q = situation.q[:, place.where["joint"] - 1]
    return np.column_stack([np.sin(q), np.cos(q)])


EFFECT = GearEccentricity()
