"""A link is longer or shorter than its description says."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.effect import Place, Quantity, StaticEffect, joints, number
from app.diagnosis.static.geometry import AXES

#: m: more is another arm.
LARGEST = 0.05


class LinkLength(StaticEffect):
    key = "link_length"
    title = "A link is longer or shorter"
    equation = "T_link_next = T_nominal shifted by offset along a (common normal) or d (joint axis)"
    rank = 5

    def places(self, situation):
        return [Place({"link": k, "axis": axis}) for k in joints(situation) for axis in ("a", "d")]

    def quantities(self, situation, place):
        return (Quantity("offset", "mm", -LARGEST, LARGEST),)

    def apply(self, cell, situation, place, values):
        k = place.where["link"] - 1
        vector = situation.links.vectors[k, AXES.index(place.where["axis"])]
        return cell.add_link(k, values[0] * vector, np.zeros(3))

    def columns(self, columns, place):
        return columns.link[:, :, place.where["link"] - 1, AXES.index(place.where["axis"]), None]

    def sentence(self, place, parameters):
        return f"{place.where['axis']} of link {place.where['link']} is off by {number(parameters[0])}."


EFFECT = LinkLength()
