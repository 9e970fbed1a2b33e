"""A table of Denavit-Hartenberg rows in CSV as a robot description.

    # convention: standard        (or modified)
    a_mm,alpha_deg,d_mm,theta_deg,type,lower_deg,upper_deg
    0,90,180.7,0,revolute,-360,360
    -612.7,0,0,0,,,

standard: T = Rz(theta + q) Tz(d) Tx(a) Rx(alpha); modified (Craig): T = Rx(alpha) Tx(a) Rz(theta + q) Tz(d), the row
holding a and alpha in front of the joint. A prismatic row adds its q to d. One row a joint; `type` and limits may be
left out: joints turn, two turns either way, or slide a metre.

Source: Denavit and Hartenberg (1955); Craig, Introduction to Robotics, 3rd edition, eq. 3.6.
"""

from __future__ import annotations

import csv
import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.errors import CellValueError, FileFormatError, MissingColumnError
from app.geometry.pose import Pose
from app.geometry.rotation import rot_x, rot_z
from app.kinematics.description.placing import origin_element
from app.kinematics.description.plain import TWO_TURNS
from app.units import SI_FACTORS

_LARGEST = 1_000_000  # bytes
_MOST_ROWS = 100
_UNITS = {
    "a": ("mm", "m"),
    "d": ("mm", "m"),
    "alpha": ("deg", "rad"),
    "theta": ("deg", "rad"),
    "lower": ("deg", "rad", "mm", "m"),
    "upper": ("deg", "rad", "mm", "m"),
}
_TYPES = ("revolute", "prismatic")
CONVENTIONS = ("standard", "modified")


@dataclass(frozen=True)
class DhRow:
    """One joint: a and d [m], alpha and theta [rad], whether it slides, and its limits [rad or m]."""

    a: float
    alpha: float
    d: float
    theta: float
    prismatic: bool = False
    lower: float = -TWO_TURNS
    upper: float = TWO_TURNS


def is_dh_table(path: Path) -> bool:
    """True for a CSV that may hold one."""
    return path.suffix.lower() == ".csv"


def read_dh_table(path: Path) -> ET.Element:
    """The description of the arm that a table describes.

    Raises:
        FileFormatError, MissingColumnError, CellValueError: by row and column.
    """
    if path.stat().st_size > _LARGEST:
        raise FileFormatError("too large for a table of joints", file=path, expected="one row a joint")
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise FileFormatError("not UTF-8 text", file=path, expected="a DH table in CSV") from None
    convention, header, rows = "standard", None, []
    for number, line in enumerate(lines, 1):
        if line.lstrip().startswith("#"):
            key, _, value = line.lstrip("# \t").partition(":")
            if key.strip() == "convention":
                convention = value.strip()
        elif line.strip():
            cells = [cell.strip() for cell in next(csv.reader([line]))]
            if header is None:
                header = _header(cells, path, number)
            else:
                rows.append(_row(header, cells, path, number))
    if convention not in CONVENTIONS:
        raise CellValueError(
            f"found {convention[:40]!r}", file=path, column="# convention", expected=" or ".join(CONVENTIONS)
        )
    if not rows or len(rows) > _MOST_ROWS:
        raise FileFormatError(f"{len(rows)} joints", file=path, expected="one row a joint below the header")
    return dh_description(rows, modified=convention == "modified")


def dh_description(rows: Sequence[DhRow], *, modified: bool = False) -> ET.Element:
    """<robot> of links `base`, `link1`… and `flange`, joints `joint1`…, each turning or sliding along its z."""
    root = ET.Element("robot", {"name": "dh"})
    ET.SubElement(root, "link", {"name": "base"})
    carried, parent = Pose.identity(), "base"
    for number, row in enumerate(rows, 1):
        fixed = _along_x(row) if modified else Pose.identity()
        turn = Pose.of(rot_z(row.theta), np.zeros(3))
        rise = Pose.of(None, np.array([0.0, 0.0, row.d]))
        before = carried @ fixed @ turn
        if row.prismatic or modified:
            # d lies on the joint's own axis, so it may stand in front of the joint as well as behind
            before, after = before @ rise, Pose.identity()
        else:
            after = rise
        carried = after if modified else after @ _along_x(row)
        link = f"link{number}"
        ET.SubElement(root, "link", {"name": link})
        _add_joint(root, f"joint{number}", parent, link, before, row)
        parent = link
    ET.SubElement(root, "link", {"name": "flange"})
    _add_joint(root, "flange_joint", parent, "flange", carried, None)
    return root


def _along_x(row: DhRow) -> Pose:
    """Tx(a) Rx(alpha), which commute."""
    return Pose.of(rot_x(row.alpha), np.array([row.a, 0.0, 0.0]))


def _add_joint(root: ET.Element, name: str, parent: str, child: str, place: Pose, row: DhRow | None) -> None:
    kind = "fixed" if row is None else ("prismatic" if row.prismatic else "revolute")
    joint = ET.SubElement(root, "joint", {"name": name, "type": kind})
    ET.SubElement(joint, "parent", {"link": parent})
    ET.SubElement(joint, "child", {"link": child})
    joint.append(origin_element(place))
    if row is not None:
        ET.SubElement(joint, "axis", {"xyz": "0 0 1"})
        limits = {"lower": repr(row.lower), "upper": repr(row.upper), "velocity": "0", "effort": "0"}
        ET.SubElement(joint, "limit", limits)


def _header(cells: list[str], path: Path, row: int) -> dict[str, tuple[int, float, str]]:
    """Quantity -> where it stands, factor to SI, unit."""
    found: dict[str, tuple[int, float, str]] = {}
    for index, cell in enumerate(cells):
        quantity, _, unit = cell.rpartition("_")
        if cell == "type":
            found["type"] = (index, 1.0, "")
        elif unit in _UNITS.get(quantity, ()):
            found[quantity] = (index, SI_FACTORS[unit], unit)
    for quantity in ("a", "alpha", "d", "theta"):
        if quantity not in found:
            raise MissingColumnError(
                "this column is missing",
                file=path,
                row=row,
                column=" or ".join(f"{quantity}_{u}" for u in _UNITS[quantity]),
                expected="a DH table: a, alpha, d and theta of every joint",
            )
    return found


def _row(header: dict[str, tuple[int, float, str]], cells: list[str], path: Path, row: int) -> DhRow:
    def value(quantity: str, default: float) -> float:
        index, factor, unit = header.get(quantity, (len(cells), 1.0, ""))
        text = cells[index] if index < len(cells) else ""
        if not text and quantity in ("lower", "upper"):
            return default
        try:
            number = float(text) * factor
        except ValueError:
            number = math.nan
        if not abs(number) < 1e5:
            raise CellValueError(
                f"found {text[:40]!r}", file=path, row=row, column=f"{quantity}_{unit}", expected="a number"
            )
        return number

    index = header.get("type", (len(cells), 1.0, ""))[0]
    kind = (cells[index] if index < len(cells) else "") or "revolute"
    if kind not in _TYPES:
        raise CellValueError(
            f"found {kind[:40]!r}", file=path, row=row, column="type", expected=" or ".join(_TYPES)
        )
    slides = kind == "prismatic"
    far = 1.0 if slides else TWO_TURNS
    limits = value("lower", -far), value("upper", far)
    if limits[0] > limits[1]:
        raise CellValueError(
            f"found {limits[0]:g} to {limits[1]:g}",
            file=path,
            row=row,
            column="lower",
            expected="lower below upper",
        )
    a, alpha, d, theta = (value(key, 0.0) for key in ("a", "alpha", "d", "theta"))
    return DhRow(a, alpha, d, theta, slides, *limits)
