"""What a window shows of the scene: from points in base to places on the page, and back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_SIZES = 40.0, 10_000.0  # of a window that are believed [px]


def window_size(said: object) -> tuple[float, float] | None:
    """Width and height [px] as a page says them, "820 345"; None where that is no window's."""
    words = said.split() if isinstance(said, str) else []
    if len(words) != 2 or not all(word.isascii() and word.isdigit() and len(word) <= 5 for word in words):
        return None
    width, height = map(float, words)
    return (width, height) if _SIZES[0] <= min(width, height) <= max(width, height) <= _SIZES[1] else None


@dataclass(frozen=True, eq=False)
class Seen:
    """A window and the eye behind it.

    Args:
        eye, centre: (3,) where the eye is, and what is in the window's middle [m].
        field: vertical field of view [rad].
        width, height: of the window [px].
    """

    eye: np.ndarray
    centre: np.ndarray
    field: float
    width: float
    height: float

    def metres(self, pixels: float, depth: float) -> float:
        """How long something so far away is that is seen so large [m]."""
        return pixels * depth * 2.0 * float(np.tan(self.field / 2.0)) / self.height

    def pixels(self, metres: float, depth: float) -> float:
        """How large something so far away is seen [px]."""
        return metres / self.metres(1.0, depth)

    @property
    def axes(self) -> np.ndarray:
        """(3, 3) rows: right, up, ahead."""
        ahead = self.centre - self.eye
        ahead = ahead / np.linalg.norm(ahead)
        right = np.cross(ahead, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(right, ahead), ahead])

    def of(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) px right of the window's middle, px above it, depth [m]; what is behind the eye is taken for near."""
        rel = (np.asarray(points, float).reshape(-1, 3) - self.eye) @ self.axes.T
        rel[:, 2] = np.maximum(rel[:, 2], 0.02 * float(np.linalg.norm(self.centre - self.eye)))
        rel[:, :2] /= self.metres(1.0, 1.0) * rel[:, 2:]
        return rel

    def at(self, places: np.ndarray) -> np.ndarray:
        """(n, 3) points in base [m] that are seen there: px right, px above, depth [m]."""
        rel = np.array(places, float).reshape(-1, 3)
        rel[:, :2] *= self.metres(1.0, 1.0) * rel[:, 2:]
        return self.eye + rel @ self.axes
