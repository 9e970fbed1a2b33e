"""Axis and angle out of the names that points carry in a tracker's export.

`A1_-90`, `J2_+15.5`, `Axis1_030deg`, `Robot1::Axis 2::p12`: a letter or word for the axis, its number, and last in the
name the angle. A sign, a decimal point or `deg` says it is an angle, and so do whole numbers that do not just count
up by one (`A1_0, A1_10, A1_20`); `A1_1, A1_2, A1_3` are running numbers, and then the rows stand in the order of
positive motion. `m90` and `p90` are -90 and +90. Names that begin with REF, FIX or NEST are fixed points, and one that
begins with FRONT lies in front of the robot, where X looks.
Where names follow another habit, AXIS=PATTERN says which belong to which axis: `1=ROB1_FIRST_*`.
"""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Sequence

import numpy as np

from app.calibration.base.arcs import Arc, Arcs, axis_sense, header, make_arc
from app.errors import CellValueError, InputError
from app.recordings import Table
from app.units import from_deg

_AXIS = re.compile(r"(?<![A-Za-z])(?:axis|achse|joint|ax|a|j)[\s_\-]*([1-8])(?![0-9.])", re.IGNORECASE)
_FRONT = re.compile(r"(?:^|::)\s*front", re.IGNORECASE)
_FIXED = re.compile(r"(?:^|::)\s*(?:ref|fix|nest)", re.IGNORECASE)
_LAST = re.compile(
    r"(?P<sign>[+\-]|[mp](?=\d))?(?P<number>\d+(?:[.,]\d+)?)\s*(?P<deg>deg|°)?\s*\Z", re.IGNORECASE
)


def arcs_from_names(table: Table, patterns: Sequence[str] = ()) -> Arcs:
    """Arcs from a list of named points.

    Args:
        table: of kind `tracker_points`.
        patterns: AXIS=PATTERN each; none reads the names by the habit above.

    Raises:
        CellValueError: no names of axis 1 or axis 2.
        InputError: a pattern that is none.
    """
    names = table.text("name")
    points = table.numbers("xyz")
    chosen = [_axis_of(name, _parsed(patterns)) for name in names]
    arcs: dict[int, Arc] = {}
    for axis in sorted({c for c in chosen if c}):
        mine = [k for k, c in enumerate(chosen) if c == axis]
        sense = axis_sense(table, axis)
        angles = _angles([_tail(names[k], bool(patterns)) for k in mine])
        arcs[axis] = make_arc(
            axis, points[mine][:, None], None if angles is None else sense * angles, table.rows[mine], sense
        )
    for axis in (1, 2):
        if axis not in arcs:
            raise CellValueError(
                f"no point's name says axis {axis} (the first is {names[0][:40]!r})",
                file=table.path,
                column="name",
                expected="names such as A1_-90 and A2_15.5, or --axis 1=PATTERN 2=PATTERN",
            )
    references: dict[str, list[np.ndarray]] = {}
    for name, point, axis in zip(names, points, chosen, strict=True):
        if axis is None and _FIXED.search(name):
            references.setdefault(name.rpartition("::")[2], []).append(point)
    fixed = {name: np.array(found) for name, found in references.items()}
    front = [point for name, point in zip(names, points, strict=True) if _FRONT.search(name)]
    keys = header(table)
    if front:
        keys["towards"] = np.mean(front, axis=0)
    return Arcs(path=table.path, arcs=arcs, references=fixed, **keys)


def _parsed(patterns: Sequence[str]) -> list[tuple[int, str]]:
    out = []
    for text in patterns:
        axis, equals, pattern = text.partition("=")
        if not equals or not pattern or not axis.strip().isdigit() or not 1 <= int(axis) <= 8:
            raise InputError(f"--axis {text!r}", expected="AXIS=PATTERN, such as 1=ROB1_J1_*")
        out.append((int(axis), pattern))
    return out


def _axis_of(name: str, patterns: Sequence[tuple[int, str]]) -> int | None:
    if patterns:
        last = name.rpartition("::")[2]
        return next(
            (a for a, p in patterns if fnmatch.fnmatchcase(name, p) or fnmatch.fnmatchcase(last, p)), None
        )
    if _FIXED.search(name) or _FRONT.search(name):
        return None
    found = _AXIS.search(name)
    return int(found.group(1)) if found else None


def _tail(name: str, chosen: bool) -> str:
    """What is left of a name after its axis: where the angle stands."""
    if chosen:
        return name
    found = _AXIS.search(name)
    assert found is not None
    return name[found.end() :]


def _angles(tails: Sequence[str]) -> np.ndarray | None:
    """(n,) [rad], or None where the names only count."""
    parts = [_LAST.search(tail) for tail in tails]
    if any(p is None for p in parts):
        return None
    values, telling = [], False
    for k, p in enumerate(parts):
        assert p is not None
        sign, digits = p.group("sign"), p.group("number")
        # a dash that only joins (`A1-03`) is no sign: it follows a letter or digit of the name and leads zeros
        joined = sign == "-" and p.start() == 0 and digits.startswith("0") and len(digits) > 1
        negative = sign in ("-", "m", "M") and not joined
        values.append((-1.0 if negative else 1.0) * float(digits.replace(",", ".")))
        text = tails[k][p.start() :]
        telling = telling or (sign is not None and not joined) or "." in text or p.group("deg") is not None
    angles = np.array(values)
    counting = len(angles) > 1 and bool(np.all(np.abs(np.diff(angles)) == 1.0)) and not telling
    return None if counting else from_deg(angles)
