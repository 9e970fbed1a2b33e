"""The axes at the two ends of a link stand at another angle than described."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.described import Placed, only
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity, joints
from app.diagnosis.models.kinematic.geometry import AXES, link_axes
from app.diagnosis.quantity import quantity

#: rad: machining of bearing seats.
_WIDTH = 4e-4
#: rad (3 deg): no machining is off by more; beyond it the recording is of another arm.
_LARGEST = 0.05


class LinkTwist(KinematicEffect):
    """The next axis leans about the common normal (alpha) or across it (beta).

    Source: Denavit, Hartenberg (1955) for alpha; Hayati (1983) for beta.
    """

    key = "link_twist"
    title = "A link is twisted"
    equation = "T_link_next = T_nominal turned by angle about alpha (common normal) or beta (across it)"
    family = "geometry"
    located_by = ("link",)
    cap = 20.0
    whole = True
    always = True

    def places(self, situation):
        parallel = situation.links.parallel
        return [
            # across axes that are not parallel a turn is the same as zeros and lengths together
            Place({"link": k, "axis": axis}, member=axis == "alpha" or bool(parallel[k - 1]))
            for k in joints(situation)
            for axis in ("alpha", "beta")
        ]

    def quantities(self, situation, place):
        return (Quantity("angle", "deg", _WIDTH, -_LARGEST, _LARGEST),)

    def apply(self, cell, situation, place, values):
        k = place.where["link"] - 1
        vector = situation.links.vectors[k, AXES.index(place.where["axis"])]
        return cell.add_link(k, np.zeros(3), values[0] * vector)

    def columns(self, columns, place):
        return columns.link[:, :, place.where["link"] - 1, AXES.index(place.where["axis"]), None]

    def described(self, robot, where, parameters):
        if where.get("axis") not in AXES:
            return ()
        k = int(where["link"])
        vector = link_axes(robot.chain).vectors[k - 1, AXES.index(where["axis"])]
        return (Placed(k + 1, turn=vector * only(parameters)),)

    def sentence(self, place, parameters):
        return f"{place.where['axis']} of link {place.where['link']} is off by {quantity(parameters[0])}."


EFFECT = LinkTwist()
