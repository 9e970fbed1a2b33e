"""What stands in writing beside a result and at the recorded points, so that no words cover others.

Words of a result stand in one column beside the tip, one under the other by the height of what they speak of, each
with a line to it. Their size is in metres like the column's, so that they stay apart from near and from far.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import viser

from app.calibration.captures import Capture
from app.calibration.result import ToolCalibration
from app.scene.camera import View
from app.scene.region import cone_ends, cone_factor, region_factor
from app.scene.residuals import arrow_ends
from app.units import deg, mm

HEIGHT = 0.026  # of a line of words, as a share of the reach
_LETTER = 0.6  # heights a letter is wide
_LEADING = 1.35  # heights from one line to the next
_APART = 1.7  # the same of numbers of points, which have a rim
_ASIDE = 0.10  # of the reach: from the tip to the column
_GREY = (120, 130, 140)
_NUMBERS = itertools.count(1)


@dataclass(frozen=True, eq=False)
class Caption:
    """Words, and the place (3,) in base [m] they speak of."""

    text: str
    about: np.ndarray


def spread(heights: Sequence[float] | np.ndarray, gap: float) -> np.ndarray:
    """(n,) heights at least `gap` apart, in the order of those given and as near to them as that allows [m].

    Neighbours that are too near are moved apart about their middle: regression under an order, by pooling (Barlow et
    al. 1972) of the heights with the gaps taken off.
    """
    order = np.argsort(heights, kind="stable")
    free = np.asarray(heights, float)[order] - gap * np.arange(len(order))
    blocks: list[list[float]] = []  # sum, count
    for value in free:
        blocks.append([float(value), 1.0])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1][0] += total
            blocks[-1][1] += count
    pooled = np.concatenate([np.full(int(count), total / count) for total, count in blocks] or [np.zeros(0)])
    out = np.empty(len(order))
    out[order] = pooled + gap * np.arange(len(order))
    return out


def of_result(result: ToolCalibration, *, misses: bool) -> list[Caption]:
    """What a result's drawings say: each touch's miss, the region, the axes."""
    found: list[Caption] = []
    if misses:
        ends = arrow_ends(result)
        for number, (end, miss) in enumerate(zip(ends, result.per_point, strict=True), 1):
            found.append(Caption(f"{number}: {mm(float(miss)):.2f} mm", end))
    if result.sigma > 0:
        found.append(Caption(f"95% ×{region_factor(result)}", result.p_base))
    return found


def of_axes(result: ToolCalibration, T_base_flange: np.ndarray) -> list[Caption]:
    """What the cones of the taught axes say; they stand where the flange T_base_flange (4, 4) holds the tool."""
    return [
        Caption(
            f"+{cone.axis.upper()} ±{deg(cone.half_angle):.2f}° ×{cone_factor(cone)}",
            T_base_flange[:3, :3] @ end + T_base_flange[:3, 3],
        )
        for cone, end in zip(result.cones, cone_ends(result), strict=True)
    ]


def column(captions: Sequence[Caption], beside: np.ndarray, ahead: np.ndarray, reach: float) -> np.ndarray:
    """(n, 3) where the words begin: a column beyond the tip.

    Args:
        beside: (3,) the tip [m].
        ahead: (3,) unit, level: from the arm to the tip.
        reach: of the arm [m].
    """
    heights = spread([float(c.about[2]) for c in captions], _LEADING * HEIGHT * reach)
    place = np.tile(beside + _ASIDE * reach * ahead, (len(captions), 1))
    place[:, 2] = heights
    return place


class Captions:
    """Labels with lines to what they speak of.

    Args:
        scene: the session's.
        reach: of the arm [m].
    """

    def __init__(self, scene: viser.SceneApi, reach: float):
        self._scene, self._reach = scene, reach
        self._handles: list[viser.SceneNodeHandle] = []
        self._shown: tuple[Sequence[Caption], np.ndarray] = (), np.zeros((0, 3))

    def corners(self, right: np.ndarray) -> np.ndarray:
        """(n, 3) where the lines begin and end on a page whose right is `right` (3,), in base [m]."""
        captions, places = self._shown
        lengths = np.array([len(c.text) for c in captions]) * _LETTER * HEIGHT * self._reach
        return np.vstack([places, places + lengths[:, None] * right])

    def clear(self) -> None:
        """Takes all away."""
        for handle in self._handles:
            handle.remove()
        self._handles, self._shown = [], ((), np.zeros((0, 3)))

    def show(self, captions: Sequence[Caption], places: np.ndarray) -> None:
        """These at these places (n, 3), in base [m]."""
        self.clear()
        if not captions:
            return
        self._shown = captions, places
        root = f"/captions{next(_NUMBERS)}"
        lines = np.array([[c.about, place] for c, place in zip(captions, places, strict=True)], np.float32)
        self._handles.append(
            self._scene.add_line_segments(
                f"{root}/lines", lines, _GREY, thickness=1.5, thickness_units="screen"
            )
        )
        for number, (caption, place) in enumerate(zip(captions, places, strict=True)):
            self._handles.append(
                self._scene.add_label(
                    f"{root}/{number}",
                    caption.text,
                    position=(float(place[0]), float(place[1]), float(place[2])),
                    font_size_mode="scene",
                    font_scene_height=HEIGHT * self._reach,
                    anchor="center-left",
                )
            )


def of_points(captures: Sequence[Capture], view: View, reach: float) -> tuple[list[Caption], np.ndarray]:
    """Numbers of recorded points, and places (n, 3) for them over the flanges, on a line of its own each.

    Args:
        view: from where they are not to cover each other.
        reach: of the arm [m].
    """
    found = [Caption(str(number), c.T_base_flange.position) for number, c in enumerate(captures, 1)]
    places = np.array([c.about for c in found]).reshape(-1, 3)
    if not len(found):
        return found, places
    places[:, 2] += HEIGHT * reach
    eye, centre = view
    ahead = (centre - eye) / np.linalg.norm(centre - eye)
    up = np.array([0.0, 0.0, 1.0]) - ahead[2] * ahead
    up /= np.linalg.norm(up)
    depths = (places - eye) @ ahead
    heights = (places - eye) @ up / depths  # as seen
    apart = spread(heights, _APART * HEIGHT * reach / float(depths.min()))
    places[:, 2] += (apart - heights) * depths / (up[2] - apart * ahead[2])
    return found, places
