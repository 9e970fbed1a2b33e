"""A description's numbers, names and sizes, looked at before any compiled library sees them."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from pathlib import Path

from app.errors import FileFormatError, InputError

#: What no robot exceeds. Beyond, a number is broken or a unit is (millimetres written for metres: still within).
_FARTHEST, _HEAVIEST, _MOST_TURNED = 1e5, 1e6, 1e4  # m, kg, rad
_MOST_LINKS = 1000  # humanoids have some 150
_LONGEST_NAME = 200
_TAKEN = frozenset({"universe"})  # the name of the fixed world in pin

#: (element, attribute) -> how many numbers, and the largest.
_ATTRIBUTES = {
    ("origin", "xyz"): (3, _FARTHEST),
    ("origin", "rpy"): (3, _MOST_TURNED),
    ("axis", "xyz"): (3, _FARTHEST),
    ("mass", "value"): (1, _HEAVIEST),
    ("box", "size"): (3, _FARTHEST),
    ("cylinder", "radius"): (1, _FARTHEST),
    ("cylinder", "length"): (1, _FARTHEST),
    ("cylinder", "top_radius"): (1, _FARTHEST),
    ("capsule", "radius"): (1, _FARTHEST),
    ("capsule", "length"): (1, _FARTHEST),
    ("sphere", "radius"): (1, _FARTHEST),
    ("mesh", "scale"): (3, _FARTHEST),
    ("color", "rgba"): (4, 1e3),
    ("mimic", "multiplier"): (1, 1e4),
    ("mimic", "offset"): (1, _FARTHEST),
    ("limit", "lower"): (1, 1e9),
    ("limit", "upper"): (1, 1e9),
    ("limit", "velocity"): (1, 1e30),
    ("limit", "effort"): (1, 1e30),
    **{("inertia", key): (1, 1e9) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")},
}
#: Element -> its attributes that are numbers: (attribute, how many, the largest).
NUMBERS: dict[str, list[tuple[str, int, float]]] = {}
for (_tag, _key), (_count, _largest) in _ATTRIBUTES.items():
    NUMBERS.setdefault(_tag, []).append((_key, _count, _largest))
_SIZES = {("box", "size"), ("cylinder", "radius"), ("cylinder", "length"), ("sphere", "radius")}


def check_description(root: ET.Element, path: Path) -> None:
    """Raises for the first thing in a description that cannot be.

    Raises:
        FileFormatError: not a robot, too many links, a name that cannot be used, an axis of no length.
        InputError: a number that is none, or beyond what a robot can have.
    """
    if root.tag != "robot":
        raise FileFormatError(f"the outermost element is <{root.tag[:40]}>", file=path, expected="<robot>")
    counts = {tag: len(root.findall(tag)) for tag in ("link", "joint")}
    for tag, count in counts.items():
        if count > _MOST_LINKS:
            raise FileFormatError(f"{count} {tag}s", file=path, expected=f"at most {_MOST_LINKS}")
    for owner in root:
        name = owner.get("name", "")
        if owner.tag in ("link", "joint"):
            _check_name(name, owner.tag, path)
        for element in owner.iter():
            for key, count, largest in NUMBERS.get(element.tag, ()):
                if key in element.attrib:
                    _check_numbers(element, key, count, largest, f"{owner.tag} {name!r}", path)
        if owner.tag == "joint":
            _check_axis(owner, name, path)


def _check_name(name: str, tag: str, path: Path) -> None:
    if not name.strip() or len(name) > _LONGEST_NAME or not name.isprintable():
        raise FileFormatError(f"a {tag} called {name[:40]!r}", file=path, expected="a printable name")
    if name in _TAKEN:
        raise FileFormatError(
            f"a {tag} is called {name!r}, which is the fixed world's own name",
            file=path,
            expected="another name",
        )


def _check_numbers(element: ET.Element, key: str, count: int, largest: float, owner: str, path: Path) -> None:
    text = element.get(key, "")
    words = text.split()
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    what = f"{element.tag} {key} of {owner} is {text[:40]!r}"
    if len(values) != count and not (element.tag == "color" and len(values) == 3):
        raise InputError(what, file=path, expected="a number" if count == 1 else f"{count} numbers")
    if not all(math.isfinite(v) and abs(v) <= largest for v in values) and not (
        element.tag == "limit" and len(values) == 1 and not math.isnan(values[0])
    ):
        raise InputError(what, file=path, expected=f"finite numbers of at most {largest:g}")
    if (element.tag, key) in _SIZES and min(values) < 0:
        raise InputError(what, file=path, expected="a size that is not negative")
    if element.tag == "mass" and values[0] < 0:
        raise InputError(what, file=path, expected="a mass that is not negative")


def _check_axis(joint: ET.Element, name: str, path: Path) -> None:
    axis = joint.find("axis")
    if axis is None or joint.get("type") == "fixed":
        return
    length = math.hypot(*(float(v) for v in axis.get("xyz", "1 0 0").split()))
    if not length > 1e-6:
        raise FileFormatError(
            f"the axis of joint {name!r} has no direction", file=path, expected="an axis such as 0 0 1"
        )
