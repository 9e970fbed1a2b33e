"""What lengths and twists of links have in common: the placement behind a link, moved along one of its axes."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.described import Placed, only
from app.diagnosis.effects.kinematic._base import KinematicEffect
from app.diagnosis.models.kinematic.geometry import AXES, link_axes
from app.diagnosis.quantity import quantity


class LinkEffect(KinematicEffect):
    """Base of effects on the geometry of one link.

    Attributes:
        turns: True where the next axis is turned about an axis of the link, False where it is shifted along one.
    """

    family = "geometry"
    located_by = ("link",)
    cap = 20.0
    whole = True
    always = True
    built = True
    turns: bool

    def apply(self, cell, situation, place, values):
        k = place.where["link"] - 1
        vector = values[0] * situation.links.vectors[k, AXES.index(place.where["axis"])]
        none = np.zeros(3)
        return cell.add_link(k, none, vector) if self.turns else cell.add_link(k, vector, none)

    def columns(self, columns, place):
        return columns.link[:, :, place.where["link"] - 1, AXES.index(place.where["axis"]), None]

    def described(self, robot, where, parameters):
        if where.get("axis") not in AXES:
            return ()
        k = int(where["link"])
        vector = link_axes(robot.chain).vectors[k - 1, AXES.index(where["axis"])] * only(parameters)
        return (Placed(k + 1, turn=vector) if self.turns else Placed(k + 1, shift=vector),)

    def sentence(self, place, parameters):
        return f"{place.where['axis']} of link {place.where['link']} is off by {quantity(parameters[0])}."
