"""The axes at the two ends of a link stand at another angle than described."""

from __future__ import annotations

from app.diagnosis.effects.kinematic._base import Place, Quantity, joints
from app.diagnosis.effects.kinematic._link import LinkEffect

#: rad: machining of bearing seats.
_WIDTH = 4e-4
#: rad (3 deg): no machining is off by more; beyond it the recording is of another arm.
_LARGEST = 0.05


class LinkTwist(LinkEffect):
    """The next axis leans about the common normal (alpha) or across it (beta).

    Source: Denavit, Hartenberg (1955) for alpha; Hayati (1983) for beta.
    """

    key = "link_twist"
    title = "A link is twisted"
    equation = "T_link_next = T_nominal turned by angle about alpha (common normal) or beta (across it)"
    turns = True

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


EFFECT = LinkTwist()
