"""What was recorded: for every axis the places a reflector went through while that axis alone was turned."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from app.errors import CellValueError, FileFormatError, MissingColumnError
from app.recordings import Table
from app.units import from_deg, from_mm

HIGHEST_AXIS = 8
REFERENCE = 0  # rows with this axis number are points that do not move with any robot


@dataclass(frozen=True, eq=False)
class Arc:
    """One axis turned alone.

    Args:
        axis: its number, from 1.
        points: (n, 3) [m] in the tracker's frame.
        angles: (n,) [rad] right-handed about the axis' positive direction, or None: then the rows stand in the
            order of positive motion.
        rows: (n,) line numbers in the file.
        reflectors: (n,) which reflector, from 0.
        sense: +1 or -1, what the recorded angles were multiplied by.
    """

    axis: int
    points: np.ndarray
    angles: np.ndarray | None
    rows: np.ndarray
    reflectors: np.ndarray
    sense: int = 1

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True, eq=False)
class Arcs:
    """Everything one file says about one robot.

    Args:
        path: the file.
        arcs: by axis number.
        towards: (3,) [m] in front of the robot, or None.
        noise: stated one-sigma noise of a coordinate [m], or None.
        noise_per_m: what it grows by for every metre from the tracker, dimensionless.
        axis2_at: stated angle of joint 1 while axis 2 was turned [rad], or None.
        robot: the description's name or path as written, or None.
        references: fixed points by name, (k, 3) [m] each time they were measured.
        floor: half a step of the last digit written, as one-sigma noise [m].
    """

    path: Path
    arcs: Mapping[int, Arc]
    towards: np.ndarray | None = None
    noise: float | None = None
    noise_per_m: float = 0.0
    axis2_at: float | None = None
    robot: str | None = None
    references: Mapping[str, np.ndarray] = field(default_factory=dict)
    floor: float = 0.0

    def sigma(self, points: np.ndarray) -> np.ndarray | None:
        """(n,) [m] stated noise of every point, or None where the file states none."""
        if self.noise is None:
            return None
        return self.noise + self.noise_per_m * np.linalg.norm(points, axis=-1)


def read_arcs(table: Table) -> Arcs:
    """Arcs from a table of kind `arcs`.

    Raises:
        FileFormatError: another kind.
        MissingColumnError, CellValueError: a column or cell that cannot be used, by its place.
    """
    if table.kind not in (None, "arcs") or (table.kind is None and not table.has("axis")):
        found = "it says no kind" if table.kind is None else f"its kind is {table.kind!r}"
        raise FileFormatError(found, file=table.path, column="kind", expected="kind: arcs")
    numbers = _axis_numbers(table)
    points = _points(table)
    angles = table.number("angle", missing=True) if table.has("angle") else None
    if angles is not None:
        _angles_complete(table, numbers, angles)
    arcs: dict[int, Arc] = {}
    for axis in sorted(set(numbers.tolist()) - {REFERENCE}):
        mine = np.flatnonzero(numbers == axis)
        sense = axis_sense(table, axis)
        shown = None if angles is None or not np.isfinite(angles[mine]).all() else sense * angles[mine]
        arcs[axis] = make_arc(axis, points[mine], shown, table.rows[mine], sense)
    for axis in (1, 2):
        if axis not in arcs:
            raise CellValueError(
                f"no row of axis {axis}",
                file=table.path,
                column="axis",
                expected="rows of axis 1 and of axis 2",
            )
    return Arcs(path=table.path, arcs=arcs, references=_references(table, numbers, points), **header(table))


def make_arc(
    axis: int, points: np.ndarray, angles: np.ndarray | None, rows: np.ndarray, sense: int = 1
) -> Arc:
    """An arc from points (n, k, 3) of k reflectors; a reflector that was not seen (NaN) is left out."""
    n, k = points.shape[:2]
    flat = points.reshape(n * k, 3)
    seen = np.isfinite(flat).all(axis=1)
    which = np.tile(np.arange(k), n)[seen]
    which = np.unique(which, return_inverse=True)[1]
    spread = None if angles is None else np.repeat(angles, k)[seen]
    return Arc(axis, flat[seen], spread, np.repeat(rows, k)[seen], which, sense)


def _axis_numbers(table: Table) -> np.ndarray:
    values = table.number("axis")
    wrong = np.flatnonzero((values != np.round(values)) | (values < REFERENCE) | (values > HIGHEST_AXIS))
    if len(wrong):
        raise CellValueError(
            f"found {values[wrong[0]]:g}",
            file=table.path,
            row=int(table.rows[wrong[0]]),
            column="axis",
            expected=f"1 or 2 (further axes up to {HIGHEST_AXIS}, 0 for a fixed point)",
        )
    return values.astype(int)


def _points(table: Table) -> np.ndarray:
    """(n, k, 3) [m]; only the second and third reflector may have empty cells."""
    first = table.numbers("xyz")
    reflectors = [first]
    for number in (2, 3):
        names = [f"{letter}{number}" for letter in "xyz"]
        if table.has(*names):
            reflectors.append(table.numbers(names, missing=True))
    return np.stack(reflectors, axis=1)


def _angles_complete(table: Table, numbers: np.ndarray, angles: np.ndarray) -> None:
    """An axis gives all of its angles or none: a single gap is a mistake in the file."""
    for axis in set(numbers.tolist()) - {REFERENCE}:
        mine = numbers == axis
        gaps = np.flatnonzero(mine & ~np.isfinite(angles))
        if 0 < len(gaps) < mine.sum():
            raise CellValueError(
                "the cell is empty",
                file=table.path,
                row=int(table.rows[gaps[0]]),
                column=table.columns["angle"].name,
                expected=f"a finite number, as in the other rows of axis {axis}",
            )


def _references(table: Table, numbers: np.ndarray, points: np.ndarray) -> dict[str, np.ndarray]:
    fixed = np.flatnonzero(numbers == REFERENCE)
    if not len(fixed):
        return {}
    if not table.has("name"):
        raise MissingColumnError(
            "rows of axis 0 are fixed points and need a name",
            file=table.path,
            row=table.header_row,
            column="name",
            expected="one name a fixed point",
        )
    names = table.text("name")
    by_name: dict[str, list[np.ndarray]] = {}
    for index in fixed:
        by_name.setdefault(names[index], []).append(points[index, 0])
    return {name: np.array(found) for name, found in by_name.items()}


def axis_sense(table: Table, axis: int) -> int:
    """`# axisN_sense`: +1 (default) or -1."""
    key = f"axis{axis}_sense"
    value = table.keys.get(key, 1)
    if isinstance(value, bool) or value not in (1, -1):
        raise CellValueError(f"found {value!r}", file=table.path, column=key, expected="1 or -1")
    return int(value)


def header(table: Table) -> dict[str, Any]:
    """The header keys every kind of arc file may carry, as arguments of `Arcs`."""
    towards = _numbers(table, "towards_workspace_mm", 3)
    noise = _numbers(table, "noise_mm", None)
    per_m = _numbers(table, "noise_mm_per_m", None)
    at = _numbers(table, "axis2_at_axis1_deg", None)
    for key, value in (("noise_mm", noise), ("noise_mm_per_m", per_m)):
        if value is not None and not (value >= 0).all():
            raise CellValueError(
                f"found {value.min():g}", file=table.path, column=key, expected="not below 0"
            )
    robot = table.keys.get("robot")
    stated = None if noise is None or not (noise > 0).all() else float(np.sqrt(np.mean(from_mm(noise) ** 2)))
    return {
        "towards": None if towards is None else from_mm(towards),
        "noise": stated,
        "noise_per_m": 0.0 if per_m is None else float(from_mm(per_m[0])),
        "axis2_at": None if at is None else float(from_deg(at[0])),
        "robot": None if robot is None else str(robot),
        "floor": max(table.resolution(letter) for letter in "xyz") / np.sqrt(12.0),
    }


def _numbers(table: Table, key: str, count: int | None) -> np.ndarray | None:
    value = table.keys.get(key)
    if value is None:
        return None
    cells = value if isinstance(value, list) else [value]
    good = all(isinstance(c, int | float) and not isinstance(c, bool) and np.isfinite(c) for c in cells)
    if not good or not cells or (count is not None and len(cells) != count):
        expected = "a number" if count is None else f"{count} numbers in brackets"
        raise CellValueError(f"found {str(value)[:40]!r}", file=table.path, column=key, expected=expected)
    return np.array(cells, float)
