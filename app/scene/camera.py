"""Where to look from."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from app.scene.eyes import Eyes
from app.simulation.world import World

View = tuple[np.ndarray, np.ndarray]  # where the eye is, what it looks at [m]

_NARROW = 0.8  # width over height from which on everything of interest is seen
_NEAREST = (
    0.78  # of the usual distance in a wide window: the arm is larger, one stretched upright just leaves it
)
_CLOSE_UP = 0.16  # of the reach: from here a millimetre is seen
_FIELD = 0.75  # vertical field of view [rad]: narrow, so that straight things look straight


def _sizes(world: World) -> tuple[float, np.ndarray, np.ndarray]:
    reach = float(world.robot.description.get("reach_m", world.robot.reach))
    ahead = np.array([*world.p_base_spike_drawn[:2], 0.0])
    ahead = ahead / max(float(np.linalg.norm(ahead)), 1e-9)
    return reach, ahead, np.array([-ahead[1], ahead[0], 0.0])


def whole(world: World) -> View:
    """The whole cell, from before the arm's right shoulder."""
    reach, ahead, left = _sizes(world)
    centre = 0.36 * reach * ahead + np.array([0.0, 0.0, 0.40 * reach])
    return centre + reach * (1.05 * ahead - 2.15 * left + np.array([0.0, 0.0, 0.62])), centre


def side(world: World) -> View:
    """Square from the side, at the height of the spike."""
    reach, _, left = _sizes(world)
    return world.p_base_spike_drawn - _CLOSE_UP * reach * left, world.p_base_spike_drawn


def front(world: World) -> View:
    """Square to the side view, from beyond the spike."""
    reach, ahead, _ = _sizes(world)
    return world.p_base_spike_drawn + _CLOSE_UP * reach * ahead, world.p_base_spike_drawn


def close(world: World) -> View:
    """The tip and the spike from near by."""
    reach, ahead, left = _sizes(world)
    offset = 0.20 * reach * (0.75 * ahead - left + np.array([0.0, 0.0, 0.45]))
    return world.p_base_spike_drawn + offset, world.p_base_spike_drawn


def result(world: World) -> View:
    """Spike, torch and recorded flanges: what a result is about."""
    reach, ahead, left = _sizes(world)
    centre = world.p_base_spike_drawn - 0.10 * reach * ahead  # words stand beyond the spike
    centre[2] = 0.5 * (centre[2] + 0.5 * reach)  # a low spike has the arm above it, a high one beside it
    return centre + 1.3 * reach * (0.38 * ahead - 0.95 * left + np.array([0.0, 0.0, 0.32])), centre


VIEWS: dict[str, Callable[[World], View]] = {"whole": whole, "side": side, "front": front, "close": close}
#: Those that go near the tip.
CLOSE_UPS = ("side", "front", "close")
#: Those that keep the tip in their middle: two at right angles show in which direction it is off.
FOLLOWING = ("side", "front")
#: Views the program takes by itself.
MORE_VIEWS = {"result": result}


def look(eyes: Eyes, view: View, *, nearer: bool = False) -> None:
    """Puts the eye there; a narrow window sees less to its sides, so from farther away.

    Args:
        nearer: in a wide window the eye may come nearer.
    """
    eye, centre = view
    eye = centre + max(_NEAREST if nearer else 1.0, _NARROW / eyes.aspect) * (eye - centre)
    eyes.look(eye, centre, _FIELD)


def look_straight(eyes: Eyes, view: View) -> None:
    """Puts the eye exactly there: the view was made for this window."""
    eyes.look(*view, _FIELD)


def framed(
    points: np.ndarray, towards_eye: np.ndarray, aspect: float, fill: float = 0.8, field: float = _FIELD
) -> View:
    """The nearest eye in a direction from which all points are seen in a window of this shape.

    Args:
        points: (n, 3) [m].
        towards_eye: (3,) from what is seen to the eye, not straight up.
        aspect: width over height of the window.
        fill: the share of the window they may take; what is left is for labels.
        field: vertical field of view [rad].
    """
    back = towards_eye / np.linalg.norm(towards_eye)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    centre = (points.min(0) + points.max(0)) / 2.0
    rel = points - centre
    half = fill * np.tan(field / 2.0)  # of the window's height, at a distance of one
    sides = np.abs(rel @ right) / (half * aspect)
    heights = np.abs(rel @ np.cross(back, right)) / half
    return centre + float(np.max(rel @ back + np.maximum(sides, heights))) * back, centre
