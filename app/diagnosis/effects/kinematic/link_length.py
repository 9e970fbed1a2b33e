"""A link is longer or shorter than its description says."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.described import Placed, only
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity, joints
from app.diagnosis.models.kinematic.geometry import AXES, link_axes
from app.diagnosis.quantity import quantity

#: m: castings and assembly of industrial arms.
_WIDTH = 3e-4
#: m: no gauge or bolt is off by more; beyond it the recording is of another arm.
_LARGEST = 0.01


class LinkLength(KinematicEffect):
    """The next axis lies farther along the common normal (a) or along the joint's own axis (d).

    Source: Denavit, Hartenberg (1955); lengths across parallel axes are one and the same.
    """

    key = "link_length"
    title = "A link is longer or shorter"
    equation = "T_link_next = T_nominal shifted by offset along a (common normal) or d (joint axis)"
    family = "geometry"
    located_by = ("link",)
    cap = 20.0
    whole = True
    always = True

    def places(self, situation):
        parallel = situation.links.parallel
        return [
            # along parallel axes the lengths of both links are one and the same
            Place({"link": k, "axis": axis}, member=axis == "a" or not parallel[k - 1])
            for k in joints(situation)
            for axis in ("a", "d")
        ]

    def quantities(self, situation, place):
        return (Quantity("offset", "mm", _WIDTH, -_LARGEST, _LARGEST),)

    def apply(self, cell, situation, place, values):
        k = place.where["link"] - 1
        vector = situation.links.vectors[k, AXES.index(place.where["axis"])]
        return cell.add_link(k, values[0] * vector, np.zeros(3))

    def columns(self, columns, place):
        return columns.link[:, :, place.where["link"] - 1, AXES.index(place.where["axis"]), None]

    def described(self, robot, where, parameters):
        if where.get("axis") not in AXES:
            return ()
        k = int(where["link"])
        vector = link_axes(robot.chain).vectors[k - 1, AXES.index(where["axis"])]
        return (Placed(k + 1, shift=vector * only(parameters)),)

    def sentence(self, place, parameters):
        return f"{place.where['axis']} of link {place.where['link']} is off by {quantity(parameters[0])}."


EFFECT = LinkLength()
