"""One joint moves with another's angle, as a wrist's gears do."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    joint_driver,
    joint_name,
    moving,
)
from app.diagnosis.quantity import quantity

#: relative: ratios of wrist gears rounded in a controller's tables.
_WIDTH = 3e-4
#: Neighbours share gears; joints farther apart hardly ever do, and only on evidence beyond this [nats].
_FAR = np.log(10.0)
#: Joints at most so far apart are neighbours.
_NEAR = 2


class JointCoupling(KinematicEffect):
    """A wrist's gears or a belt carry one joint's motion into another: q_true = q + coupling q_source."""

    key = "joint_coupling"
    title = "One joint moves another"
    equation = "q_true = q + coupling * q_source"
    family = "couplings"
    located_by = ("joint",)
    level = Level.MECHANISM
    cap = 20.0
    whole = True

    def places(self, situation):
        """Every pair; which of the others moves a joint is a choice that its evidence pays for, so that the joint's own
        zero is preferred where the other joint stood nearly still."""
        joints = moving(situation)
        places = []
        for j in joints:
            choice = np.log(max(len(joints) - 1, 1))
            for s in joints:
                if s != j:
                    near = abs(j - s) <= _NEAR
                    cost = choice if near else choice + _FAR
                    places.append(Place({"joint": j, "source_joint": s}, cost=cost, member=near))
        return places

    def quantities(self, situation, place):
        return (Quantity("coupling", "1", _WIDTH),)

    def apply(self, cell, situation, place, values):
        source = situation.q[:, place.where["source_joint"] - 1]
        return cell.add_joint(place.where["joint"] - 1, values[0] * source)

    def columns(self, columns, place):
        source = columns.situation.q[:, place.where["source_joint"] - 1]
        return joint_driver(columns, place.where["joint"], source)

    def sentence(self, place, parameters):
        return (
            f"{joint_name(place).capitalize()} is moved by joint {place.where['source_joint']}: "
            f"{quantity(parameters[0])} of its angle."
        )


EFFECT = JointCoupling()
