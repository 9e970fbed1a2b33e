"""What travels: a named tool frame with its load, and what every format can do with it."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

import numpy as np

from app.errors import FileFormatError
from app.geometry import Pose
from app.units import mm

#: A controller's whole configuration or a long program is read to its end up to here [bytes].
LARGEST = 10_000_000
#: A number as all these formats write it; taken whole or not at all, else a row of digits is tried in every way.
NUMBER = r"(?>[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?)"
LONGEST_NAME = 24
#: No tool is longer [m], and no number of an orientation larger.
_FARTHEST, _LARGEST_NUMBER = 1e3, 1e6
_SKEW = 1e-3


@dataclass(frozen=True)
class ToolFrame:
    """A tool as a controller stores it.

    Args:
        name: letters, digits and underscores, a letter first.
        pose: T_flange_tool.
        mass: of the tool [kg]; 0 where it is not known.
        com: (3,) its centre of mass in the flange [m].
    """

    name: str
    pose: Pose
    mass: float = 0.0
    com: tuple[float, float, float] = field(default=(0.0, 0.0, 0.0))

    def __post_init__(self):
        object.__setattr__(self, "name", safe_name(self.name))


def safe_name(name: str) -> str:
    """A name that every controller takes: at most 24 letters, digits and underscores, a letter first.

    KUKA's TOOL_NAME holds 24 characters, ABB's identifiers 32.
    """
    clean = re.sub(r"[^A-Za-z0-9_]", "_", name).strip("_")
    if not clean or not clean[0].isalpha():
        clean = f"tool_{clean}".strip("_")
    return clean[:LONGEST_NAME].rstrip("_")


def number(text: str, row: int | None = None, column: str | None = None) -> float:
    """A finite number of reasonable size."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not abs(value) <= _LARGEST_NUMBER:
        raise FileFormatError(f"found {text[:40]!r}", row=row, column=column, expected="a finite number")
    return value


def frame_of(
    name: str, rotation: np.ndarray, position: np.ndarray, mass: float = 0.0, com: np.ndarray | None = None
) -> ToolFrame:
    """A frame from what was read, checked: a rotation is a rotation, a tool is not a kilometre long."""
    position, rotation = np.asarray(position, float), np.asarray(rotation, float)
    if not np.isfinite(position).all() or np.abs(position).max() > _FARTHEST:
        raise FileFormatError("the tool point is no tool's", column="x, y, z", expected="metres within reach")
    sound = np.isfinite(rotation).all() and np.abs(rotation.T @ rotation - np.eye(3)).max() < _SKEW
    if not sound or np.linalg.det(rotation) < 0:
        raise FileFormatError("the orientation is no rotation", expected="a right-handed, square frame")
    if not (math.isfinite(mass) and mass >= 0.0):
        mass = 0.0
    x, y, z = (0.0, 0.0, 0.0) if com is None else (float(v) for v in com)
    return ToolFrame(name, Pose.of(rotation, position), mass, (x, y, z))


def unit_quaternion(numbers: list[float]) -> np.ndarray:
    """Four numbers as a unit quaternion (wxyz)."""
    q = np.array(numbers, float)
    length = float(np.linalg.norm(q))
    if not abs(length - 1.0) < 0.01:
        raise FileFormatError(f"the quaternion has length {length:.4g}", expected="length 1")
    return q / length


def written(value: float, places: int = 7) -> str:
    """A number with its trailing zeros taken off; never `-0`."""
    text = f"{value:.{places}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def written_mm(values: np.ndarray) -> list[str]:
    """Metres -> millimetres as text."""
    return [written(v) for v in mm(np.asarray(values, float))]


def without_comments(text: str, mark: str) -> str:
    """The text with everything blanked from `mark` to the end of its line, unless it stands inside quotes; places
    and rows stay what they were."""

    def blank(found: re.Match[str]) -> str:
        return found.group(0) if found.group(0).startswith('"') else " " * len(found.group(0))

    return re.sub(rf'"[^"\n]*"|{re.escape(mark)}[^\n]*', blank, text)
