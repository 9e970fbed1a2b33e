"""One joint moves with another's angle, as a wrist's gears do."""

from __future__ import annotations

from app.diagnosis.static.effect import (
    Place,
    Quantity,
    StaticEffect,
    joint_driver,
    joint_name,
    joints,
    number,
)

#: So near to one, a coupling is a way to count and no fault of the gears.
WHOLE = 0.02


class JointCoupling(StaticEffect):
    key = "joint_coupling"
    title = "One joint moves another"
    equation = "q_true = q + coupling * q_source"
    rank = 40
    curve = "source"

    def places(self, situation):
        return [
            Place({"joint": j, "source_joint": s})
            for j in joints(situation)
            for s in joints(situation)
            if j != s
        ]

    def quantities(self, situation, place):
        return (Quantity("coupling", "1"),)

    def apply(self, cell, situation, place, values):
        source = situation.q[:, place.where["source_joint"] - 1]
        return cell.add_joint(place.where["joint"] - 1, values[0] * source)

    def columns(self, columns, place):
        source = columns.situation.q[:, place.where["source_joint"] - 1]
        return joint_driver(columns, place.where["joint"], source)

    def sentence(self, place, parameters):
        text = (
            f"{joint_name(place).capitalize()} is moved by joint {place.where['source_joint']}: "
            f"{number(parameters[0])} of its angle."
        )
        if abs(abs(parameters[0].value) - 1.0) < WHOLE:
            # FANUC and arms with a parallel link count the forearm against the horizon.
            return text + " The controller may show it against the horizon, and not against its neighbour."
        return text


EFFECT = JointCoupling()
