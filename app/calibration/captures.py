"""What a wizard asks for and what it records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Protocol

import numpy as np

from app.calibration.result import ToolCalibration
from app.errors import CellValueError
from app.geometry import Pose

#: Every role a capture may have, with what the tip does there. One row of a file may hold two, as `touch+origin`.
ROLES: dict[str, str] = {
    "touch": "the tip touches the fixed point",
    "origin": "the tip where the strokes start",
    "x": "the tip moved along the tool's +X from the origin",
    "y": "the tip moved along the tool's +Y from the origin",
    "z": "the tip moved along the tool's +Z from the origin",
    "-x": "the tip moved along the tool's -X from the origin, as a retreat from the fixed point does",
    "-y": "the tip moved along the tool's -Y from the origin",
    "-z": "the tip moved along the tool's -Z from the origin, as for ABB's elongator points",
    "known": "the known tool's tip touches the fixed point",
    "plane": "the tip touches the plane",
    "spin": "the tool turned about its own axis",
    "minus_x": "a point on the tool's -X touches the fixed point",
    "xy": "a point of the tool's XY plane with +Y touches the fixed point",
    "world": "the tool's axes stand parallel to the base's",
}


@dataclass(frozen=True)
class Step:
    """One row of a wizard.

    Args:
        key: unique in its mode, `touch1`, `x`, …
        role: what it is for; several joined by `+`.
        title: the row's label.
        instruction: what the operator does.
        picture: file name under static/wizard, without its ending.
    """

    key: str
    role: str
    title: str
    instruction: str
    picture: str

    @property
    def roles(self) -> tuple[str, ...]:
        return split_role(self.role)


@dataclass(frozen=True, eq=False)
class Capture:
    """One recorded flange pose.

    Args:
        step_key: the step it was recorded for.
        role: that step's role.
        T_base_flange: the flange as the controller shows it.
        q: (k,) joint positions [rad or m], where they are known.
        row: line in the file, or number of the capture; for messages.
    """

    step_key: str
    role: str
    T_base_flange: Pose
    q: np.ndarray | None = None
    row: int = 0

    @property
    def roles(self) -> tuple[str, ...]:
        return split_role(self.role)


@dataclass(frozen=True, eq=False)
class Demo:
    """Captures with the truth they were made from."""

    captures: tuple[Capture, ...]
    T_flange_tool: Pose
    options: dict[str, Any]


class Mode(Protocol):
    """One way to teach a tool. A file under modes/ with an object `MODE` of this shape is a mode."""

    key: str
    title: str
    least_touches: int
    most_touches: int
    default_touches: int

    def steps(self, touches: int = 4) -> tuple[Step, ...]:
        """The wizard's rows, in order."""
        ...

    def solve(self, captures: Sequence[Capture], **options: Any) -> ToolCalibration:
        """The tool frame from one capture a step."""
        ...

    def demo(self, *, touches: int = 4, noise: float = 0.0, seed: int = 0) -> Demo:
        """Captures drawn for a known tool; `noise` one-sigma of the tip on each axis [m]."""
        ...


@lru_cache(maxsize=256)
def split_role(role: str) -> tuple[str, ...]:
    """`touch+origin` -> ("touch", "origin")."""
    return tuple(part.strip() for part in role.split("+"))


def of_role(captures: Sequence[Capture], role: str) -> list[Capture]:
    """Captures that have this role, in order."""
    return [c for c in captures if role in c.roles]


def the_one(captures: Sequence[Capture], role: str) -> Capture:
    """The only capture of this role.

    Raises:
        CellValueError: there is none, or more than one.
    """
    found = of_role(captures, role)
    if not found:
        raise CellValueError(
            f"no point has the role {role!r}", column="role", expected=f"one point where {ROLES[role]}"
        )
    if len(found) > 1:
        raise CellValueError(
            f"{len(found)} points have the role {role!r}",
            row=found[1].row or None,
            column="role",
            expected=f"one point where {ROLES[role]}",
        )
    return found[0]


def stack(captures: Sequence[Capture]) -> tuple[np.ndarray, np.ndarray]:
    """Rotations (n, 3, 3) and positions (n, 3) [m] of the flange."""
    if not captures:
        return np.zeros((0, 3, 3)), np.zeros((0, 3))
    matrices = np.array([c.T_base_flange.matrix for c in captures])
    return matrices[:, :3, :3], matrices[:, :3, 3]


def forward(captures: Sequence[Capture]) -> tuple[Capture, ...]:
    """The same captures, every stroke that was made backwards (`-z`) as the one it stands for (`z`).

    A stroke only shows a line: its end, mirrored about the origin without turning the tool, is the end of the stroke
    along the axis itself.
    """
    origins = of_role(captures, "origin")
    if not origins:
        return tuple(captures)
    start = origins[0].T_base_flange.position
    return tuple(
        replace(
            c,
            role=c.role.removeprefix("-"),
            T_base_flange=Pose.of(c.T_base_flange.rotation, 2.0 * start - c.T_base_flange.position),
        )
        if c.role.startswith("-")
        else c
        for c in captures
    )
