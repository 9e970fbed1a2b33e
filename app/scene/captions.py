"""What stands in writing beside a result and at the recorded points, so that no words cover others.

Words of a result stand in one column beside the tip, one under the other by the height of what they speak of, each
with a line to it; numbers stand over their flanges. All are laid out on the page, for the window and the view they are
looked at in, in letters that can be read there. Their size is then one in metres, so that they stay apart from near
and from far.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import viser

from app.calibration.captures import Capture
from app.calibration.result import ToolCalibration
from app.scene.region import cone_ends, cone_factor, region_factor
from app.scene.residuals import arrow_ends
from app.scene.seen import Seen
from app.units import deg, mm

HEIGHT = 0.026  # of a line of words, as a share of the reach, where that is neither too small nor too large:
LEAST_PX, MOST_PX = 13.0, 17.0
ROOM, WIDE = 0.86, 0.92  # of the window's height and width that words keep to
_LETTER = 0.6  # heights a letter is wide
_LEADING = 1.35  # heights from one line to the next
_RIM = 1.32  # the least of that: words stand on a ground of their own
_APART = 1.4  # the same of numbers of points, which have a rim
_ASIDE = 0.10  # of the reach: from the tip to the column,
_ASIDE_PX, _ASIDE_MOST = 24.0, 0.14  # but at least so far, and no more than this share of the window
_AWAY = 2.5  # lines that a number may be moved from its flange
_GREY = (120, 130, 140)
_NUMBERS = itertools.count(1)


@dataclass(frozen=True, eq=False)
class Caption:
    """Words, and the place (3,) in base [m] they speak of; `weight` tells which are left out first."""

    text: str
    about: np.ndarray
    weight: float = np.inf


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
            found.append(Caption(f"{number}: {mm(float(miss)):.2f} mm", end, float(miss)))
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


def line_px(seen: Seen, depth: float, reach: float) -> float:
    """How high a line of words is that is so far away [px]."""
    return float(np.clip(seen.pixels(HEIGHT * reach, depth), LEAST_PX, MOST_PX))


def fitting(captions: Sequence[Caption], seen: Seen) -> list[Caption]:
    """Those that can be read under each other in so high a window: the smallest misses are left out."""
    most = int(ROOM * seen.height / (_RIM * LEAST_PX))
    kept = sorted(range(len(captions)), key=lambda k: -captions[k].weight)[:most]
    return [captions[k] for k in sorted(kept)]


def room_beside(captions: Sequence[Caption], tip: np.ndarray, seen: Seen, reach: float) -> np.ndarray:
    """(n, 3) places the column needs in the window beside the tip (3,) [m]; none without words."""
    if not captions:
        return np.zeros((0, 3))
    (x, y, depth) = seen.of(tip)[0]
    wide = max(len(c.text) for c in captions) * _LETTER * line_px(seen, depth, reach)
    return seen.at(np.array([[x + _aside_px(seen, depth, reach) + wide, y, depth]]))


def _aside_px(seen: Seen, depth: float, reach: float) -> float:
    return float(np.clip(seen.pixels(_ASIDE * reach, depth), _ASIDE_PX, _ASIDE_MOST * seen.width))


def column(
    captions: Sequence[Caption], tip: np.ndarray, seen: Seen, reach: float
) -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) where the words begin, in a column right of the tip (3,) and within the window, and (n,) their height [m].

    Args:
        reach: of the arm [m].
    """
    if not captions:
        return np.zeros((0, 3)), np.zeros(0)
    x, _, depth = seen.of(tip)[0]
    size, most = line_px(seen, depth, reach), ROOM * seen.height
    gap = min(_LEADING * size, most / len(captions))
    size = min(size, gap / _RIM)
    half, edge = 0.5 * most - 0.5 * size, 0.5 * WIDE * seen.width
    heights = spread(np.clip(seen.of(np.array([c.about for c in captions]))[:, 1], -half, half), gap)
    heights += max(-half - heights.min(), 0.0) - max(heights.max() - half, 0.0)
    wide = max(len(c.text) for c in captions) * _LETTER * size
    begins = float(np.clip(x + _aside_px(seen, depth, reach), -edge, edge - wide))
    places = seen.at(np.array([[begins, y, depth] for y in heights]))
    return places, np.full(len(captions), seen.metres(size, depth))


#: Captions, places (n, 3), heights (n,) [m].
_NOTHING: tuple[Sequence[Caption], np.ndarray, np.ndarray] = (), np.zeros((0, 3)), np.zeros(0)


class Captions:
    """Labels with lines to what they speak of.

    Args:
        scene: the session's.

    Attributes:
        shown: captions, places (n, 3), heights (n,) [m].
    """

    def __init__(self, scene: viser.SceneApi):
        self._scene = scene
        self._handles: list[viser.SceneNodeHandle] = []
        self.shown = _NOTHING

    def corners(self, right: np.ndarray) -> np.ndarray:
        """(n, 3) where the lines begin and end on a page whose right is `right` (3,), in base [m]."""
        captions, places, heights = self.shown
        lengths = np.array([len(c.text) for c in captions]) * _LETTER * heights
        return np.vstack([places, places + lengths[:, None] * right])

    def clear(self) -> None:
        """Takes all away."""
        for handle in self._handles:
            handle.remove()
        self._handles, self.shown = [], _NOTHING

    def show(self, captions: Sequence[Caption], places: np.ndarray, heights: np.ndarray) -> None:
        """These at these places (n, 3) in base, so high (n,) [m]."""
        self.clear()
        if not captions:
            return
        self.shown = captions, places, heights
        root = f"/captions{next(_NUMBERS)}"
        lines = np.array([[c.about, place] for c, place in zip(captions, places, strict=True)], np.float32)
        self._handles.append(
            self._scene.add_line_segments(
                f"{root}/lines", lines, _GREY, thickness=1.5, thickness_units="screen"
            )
        )
        for number, (caption, place, height) in enumerate(zip(captions, places, heights, strict=True)):
            self._handles.append(
                self._scene.add_label(
                    f"{root}/{number}",
                    caption.text,
                    position=(float(place[0]), float(place[1]), float(place[2])),
                    font_size_mode="scene",
                    font_scene_height=float(height),
                    anchor="center-left",
                )
            )


def boxes(words: Captions, seen: Seen) -> list[tuple[float, float, float, float]]:
    """What shown words, which begin where they stand, take of the window: left, right, bottom, top [px]."""
    captions, places, heights = words.shown
    out = []
    for caption, (x, y, depth), height in zip(captions, seen.of(places), heights, strict=True):
        size = seen.pixels(height, depth)
        high = 0.5 * _RIM * size
        # A letter more at either end: a number beside "2: 0.14 mm" would read as one with it.
        out.append((x - _LETTER * size, x + (len(caption.text) + 1) * _LETTER * size, y - high, y + high))
    return out


def of_points(
    captures: Sequence[Capture],
    seen: Seen,
    reach: float,
    taken: Sequence[tuple[float, float, float, float]] = (),
) -> tuple[list[Caption], np.ndarray, np.ndarray]:
    """Numbers of recorded points, (n, 3) places over the flanges for them, and (n,) their height [m].

    Where one would cover another, or what is `taken` (left, right, bottom, top [px]), it stands over that; one that has
    no room near its flange is left out: in a low window, or far away.
    """
    found = [Caption(str(number), c.T_base_flange.position) for number, c in enumerate(captures, 1)]
    if not found:
        return found, np.zeros((0, 3)), np.zeros(0)
    at = seen.of(np.array([c.about for c in found]))
    stood, kept = list(taken), []
    for k in sorted(range(len(found)), key=lambda k: at[k, 1]):
        size = line_px(seen, at[k, 2], reach)
        half, high = 0.5 * (len(found[k].text) * _LETTER + _APART - 1.0) * size, 0.5 * _APART * size
        x, y = at[k, 0], at[k, 1] + size
        for left, right, bottom, top in sorted(stood, key=lambda one: one[2]):
            if x - half < right and left < x + half and y - high < top and bottom < y + high:
                y = top + high
        if y - at[k, 1] <= _AWAY * size:
            stood.append((x - half, x + half, y - high, y + high))
            kept.append((k, (x, y, at[k, 2]), seen.metres(size, at[k, 2])))
    kept.sort(key=lambda one: one[0])
    places = seen.at(np.array([place for _, place, _ in kept]))
    return [found[k] for k, _, _ in kept], places, np.array([height for _, _, height in kept])
