"""What the tip feels at the spike on its way: it stops where it is nearest, and goes on only away from there.

Within `World.contact_distance` of the spike's point the tip touches. A motion into that zone runs on as long as it
comes nearer, so that a touch is as good as the direction allows; there it stops, and goes no further in that
direction until it has left the zone. Beside the point the spike is solid: the tip may press into it by no more than
`PRESS`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from app.geometry import Pose
from app.kinematics import Contact
from app.kinematics.shapes import Shape
from app.simulation.world import World, default_tool
from app.units import from_mm

PRESS = from_mm(0.3)  # what the force of a touch bends, at most
_STEP = from_mm(0.4)  # the way is looked at this finely near the spike
_NEAR = from_mm(80.0)  # farther from the spike's point its sharpened end cannot be met
_CURVED = 1.3  # a way is longer than its chord
_STILL = 1e-5  # m: shorter than this is rounding of the inverse kinematics, and has no direction
_ALONG = 0.2  # cosine above which a motion counts as going on in the direction of the touch

Felt = Literal["", "touch", "press"]


class Feeling:
    """Follows the tip of one arm along its ways.

    Args:
        world: whose true tip and true spike meet.
        held: the tool's shapes, in the flange's frame.
        obstacles: what stands around; with the link "spike" the sharpened end of the spike, as it is drawn.
    """

    def __init__(self, world: World, held: Sequence[Shape], obstacles: Sequence[Shape]):
        self._world = world
        T_tool_flange = default_tool(world.robot).inverse()
        moved = Pose.of(None, world.p_base_spike - world.p_base_spike_drawn)
        self._contact = Contact(
            [s.moved(0, T_tool_flange) for s in held if s.link.replace("_", " ") == "tool tip"],
            [s.moved(0, moved) for s in obstacles if s.link == "spike"],
        )
        self._direction: np.ndarray | None = None  # of the touch that stopped the tip
        self._nearing = self._leaving = False
        self._approach = np.zeros(3)  # the last direction in which it came nearer
        self._at = np.zeros(0)

    def leave(self, q: np.ndarray) -> None:
        """A way begins at q (n,): where that is a touch, the tip may come nearer still on its way out of it."""
        self._leaving = self._world.touching(q)

    def along(self, start: np.ndarray, end: np.ndarray, way: float) -> tuple[float, Felt]:
        """How much of the straight joint way from start to end (n,) is free, and what is felt there.

        Args:
            way: upper bound of the tip's way [m].

        Returns:
            Share of the way, 0..1, and "" where nothing stops it.
        """
        world = self._world
        before = world.tip(start)
        distance = self._from_point(before)
        if distance - way > _NEAR:
            self._direction, self._nearing, self._at = None, False, end
            return 1.0, ""
        if not np.array_equal(start, self._at):
            self._nearing = False
        depth = self._contact.distance(before)
        moved = np.linalg.norm(world.tip(end).position - before.position)
        steps = 1 + int(_CURVED * moved / _STEP)
        for k in range(1, steps + 1):
            tip = world.tip(start + (end - start) * (k / steps))
            moved, now = tip.position - before.position, self._from_point(tip)
            deeper = self._contact.distance(tip) if now < _NEAR else np.inf
            felt = self._stopped(moved, distance, now, depth, deeper)
            if felt:
                self._at = start + (end - start) * ((k - 1) / steps)
                return (k - 1) / steps, felt
            before, distance, depth = tip, now, deeper
        self._at = end
        return 1.0, ""

    def _from_point(self, tip: Pose) -> float:
        return float(np.linalg.norm(tip.position - self._world.p_base_spike))

    def _stopped(self, moved: np.ndarray, distance: float, now: float, depth: float, deeper: float) -> Felt:
        zone = self._world.contact_distance
        length = float(np.linalg.norm(moved))
        if length <= _STILL:
            return ""
        if self._direction is not None:
            if now > zone and now > distance:
                self._direction = None  # away from the spike: free again
            elif moved @ self._direction > _ALONG * length:
                return "touch"
        self._leaving = self._leaving and now <= zone
        if (distance <= zone or now <= zone) and not self._leaving:
            if now < distance:
                self._nearing, self._approach = True, moved / length
            elif self._nearing:
                self._nearing = False
                if moved @ self._approach > _ALONG * length:  # not turned back: it would go past
                    self._direction = self._approach
                    return "touch"
        else:
            self._nearing = False
        solid = -PRESS if min(now, distance) <= zone else 0.0
        return "press" if deeper < solid and deeper < depth else ""
