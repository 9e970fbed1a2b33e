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
        T_tool_flange = default_tool(world.robot).inverse()
        moved = Pose.of(None, world.p_base_spike - world.p_base_spike_drawn)
        contact = Contact(
            [s.moved(0, T_tool_flange) for s in held if s.link.replace("_", " ") == "tool tip"],
            [s.moved(0, moved) for s in obstacles if s.link == "spike"],
        )
        self._begin(world, contact)

    def again(self) -> Feeling:
        """One for another arm in the same cell, or for a way that is only looked at: nothing felt yet."""
        out = Feeling.__new__(Feeling)
        out._begin(self._world, self._contact.again())
        return out

    def _begin(self, world: World, contact: Contact) -> None:
        self._world, self._contact = world, contact
        self._direction: np.ndarray | None = None  # of the touch that stopped the tip
        self._nearing = self._leaving = False
        self._approach = np.zeros(3)  # the last direction in which it came nearer
        self._at = np.zeros(0)
        self._clear = 0.0  # m that the tip may move from there and feel nothing

    def leave(self, q: np.ndarray) -> None:
        """A way begins at q (n,): where that is a touch, the tip may come nearer still on its way out of it."""
        self._leaving, self._clear = self._world.touching(q), 0.0

    def along(self, start: np.ndarray, end: np.ndarray, way: float) -> tuple[float, Felt]:
        """How much of the straight joint way from start to end (n,) is free, and what is felt there.

        Args:
            way: upper bound of the tip's way [m].

        Returns:
            Share of the way, 0..1, and "" where nothing stops it.
        """
        world, follows = self._world, np.array_equal(start, self._at)
        if follows and self._clear > way:
            self._clear, self._at = self._clear - way, end
            return 1.0, ""
        before = world.tip(start)
        distance = self._from_point(before)
        if distance - way > _NEAR:
            self._direction, self._nearing, self._at, self._clear = None, False, end, distance - way - _NEAR
            return 1.0, ""
        self._nearing = self._nearing and follows
        depth = self._contact.distance(before)
        moved = np.linalg.norm(world.tip(end).position - before.position)
        steps, k = 1 + int(_CURVED * moved / _STEP), 0
        while k < steps:
            # Nothing of the tip moves further than `way / steps` a step: so many are clear of the spike for sure.
            clear = min(int(self._clearance(distance, depth) * steps / max(way, _STILL)), steps - k)
            k += max(clear, 1)
            tip = world.tip(start + (end - start) * (k / steps))
            moved, now = tip.position - before.position, self._from_point(tip)
            deeper = self._contact.distance(tip) if now < _NEAR else np.inf
            felt = self._stopped(moved, distance, now, depth, deeper)
            if felt:
                self._at, self._clear = start + (end - start) * ((k - 1) / steps), 0.0
                return (k - 1) / steps, felt
            before, distance, depth = tip, now, deeper
        self._at, self._clear = end, self._clearance(distance, depth)
        return 1.0, ""

    def _clearance(self, distance: float, depth: float) -> float:
        """m that the tip may move wherever it likes and feel nothing; 0 within a touch.

        Args:
            distance: of the tip to the spike's point; depth to the spike's end, both [m].
        """
        if self._direction is not None or self._leaving:
            return 0.0
        return distance - _NEAR if distance >= _NEAR else min(depth, distance - self._world.contact_distance)

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
