"""The axes at the two ends of a link stand at another angle than described."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.effect import Place, Quantity, StaticEffect, joints, number
from app.diagnosis.static.geometry import AXES

#: rad: more is another arm.
LARGEST = 0.2


class LinkTwist(StaticEffect):
    key = "link_twist"
    title = "A link is twisted"
    equation = "T_link_next = T_nominal turned by angle about alpha (common normal) or beta (across it)"
    rank = 7

    def places(self, situation):
        return [Place({"link": k, "axis": axis}) for k in joints(situation) for axis in ("alpha", "beta")]

    def quantities(self, situation, place):
        return (Quantity("angle", "deg", -LARGEST, LARGEST),)

    def apply(self, cell, situation, place, values):
        k = place.where["link"] - 1
        vector = situation.links.vectors[k, AXES.index(place.where["axis"])]
        return cell.add_link(k, np.zeros(3), values[0] * vector)

    def columns(self, columns, place):
        return columns.link[:, :, place.where["link"] - 1, AXES.index(place.where["axis"]), None]

    def sentence(self, place, parameters):
        return f"{place.where['axis']} of link {place.where['link']} is off by {number(parameters[0])}."


EFFECT = LinkTwist()
