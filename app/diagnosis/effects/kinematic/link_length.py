"""A link is longer or shorter than its description says."""

from __future__ import annotations

from app.diagnosis.effects.kinematic._base import Place, Quantity, joints
from app.diagnosis.effects.kinematic._link import LinkEffect

#: m: castings and assembly of industrial arms.
_WIDTH = 3e-4
#: m: no gauge or bolt is off by more; beyond it the recording is of another arm.
_LARGEST = 0.01


class LinkLength(LinkEffect):
    """The next axis lies farther along the common normal (a) or along the joint's own axis (d).

    Source: Denavit, Hartenberg (1955); lengths across parallel axes are one and the same.
    """

    key = "link_length"
    title = "A link is longer or shorter"
    equation = "T_link_next = T_nominal shifted by offset along a (common normal) or d (joint axis)"
    turns = False

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


EFFECT = LinkLength()
