"""ROS: the command that publishes a static transform (tf2_ros); metres, quaternion x y z w by name.

Read are the named form of ROS 2 and both forms of ROS 1: x y z yaw pitch roll, and x y z qx qy qz qw; on a command
line, also one that goes on after a backslash, or as `args` of a node in a launch file.
"""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from app.calibration.exchange._frame import ToolFrame, frame_of, number, unit_quaternion, written
from app.calibration.exchange._tools import Reader, Rows, Tool, all_zero
from app.errors import FileFormatError
from app.geometry import convention, rotation_from_quaternion

_COMMAND = re.compile(
    r"""static_transform_publisher["']?(?:[ \t]{1,200}(?!name\s{0,9}=|args\s{0,9}=)([^\n>]{0,2000})|"""
    r"""[^>]{0,500}?\bargs\s{0,9}=\s{0,9}["']([^"']{0,2000})["'])"""
)
_NAMED = re.compile(r"(?<!\S)--([a-z-]{1,40})[ =]{1,40}(\S{1,200})")
_EXPECTED = "static_transform_publisher --x … --qw … --frame-id flange --child-frame-id tool"


class RosStatic(Reader):
    key = "ros_static"
    title = "ROS static transform"
    suffix = ".sh"
    suffixes = (".sh", ".launch")
    lacks = "it publishes no static transform"
    absent = _EXPECTED

    def knows(self, text: str) -> bool:
        return _COMMAND.search(_joined(text)) is not None

    def write(self, frame: ToolFrame) -> str:
        w, *vector = frame.pose.quaternion
        names = [*zip(("x", "y", "z"), frame.pose.position, strict=True)]
        names += [*zip(("qx", "qy", "qz", "qw"), (*vector, w), strict=True)]
        values = " ".join(f"--{name} {written(value, 12)}" for name, value in names)
        return (
            f"ros2 run tf2_ros static_transform_publisher {values} "
            f"--frame-id flange --child-frame-id {frame.name}\n"
        )

    def tools(self, text: str) -> list[Tool]:
        rows = Rows(text)
        tools = []
        for found in _COMMAND.finditer(_joined(text)):
            row = rows(found.start())
            arguments = (found.group(1) or found.group(2) or "").strip()
            named = dict(_NAMED.findall(arguments))
            words = tuple(arguments.split())
            make = partial(_by_name, named, row) if named else partial(_by_place, words, row)
            tools.append(Tool(_child(named, words), 0, row, words, _bare(named, words), make))
        return tools


def _child(named: dict[str, str], words: tuple[str, ...]) -> str:
    """The tool's frame, behind all numbers and the flange's frame."""
    if named:
        return named.get("child-frame-id", "")
    names = [word for word in words if not _is_number(word)]
    return names[1] if len(names) > 1 else ""


def _bare(named: dict[str, str], words: tuple[str, ...]) -> bool:
    if named:
        return all_zero(
            named.get(key, "0") for key in ("x", "y", "z", "qx", "qy", "qz", "roll", "pitch", "yaw")
        )
    numbers = [word for word in words[:7] if _is_number(word)]
    return all_zero(numbers[:6])


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _joined(text: str) -> str:
    """Lines that go on after a backslash as one; places stay what they were."""
    return text.replace("\\\r\n", "   ").replace("\\\n", "  ")


def _by_name(named: dict[str, str], row: int) -> ToolFrame:
    def value(key: str, default: str = "0") -> float:
        return number(named.get(key, default), row, key)

    position = np.array([value(k) for k in "xyz"])
    if {"qx", "qy", "qz", "qw"} & set(named):
        q = unit_quaternion([value("qw", "1"), value("qx"), value("qy"), value("qz")])
        rotation = rotation_from_quaternion(q)
    else:
        rotation = convention("XYZ").to_rotation(np.array([value("roll"), value("pitch"), value("yaw")]))
    return frame_of(named.get("child-frame-id", "tool"), rotation, position)


def _by_place(words: tuple[str, ...], row: int) -> ToolFrame:
    values: list[float] = []
    for word in words[:7]:
        try:
            float(word)
        except ValueError:
            break
        values.append(number(word, row))
    names = words[len(values) :]
    name = names[1] if len(names) > 1 else "tool"
    if len(values) == 7:
        x, y, z, w = values[3:]
        return frame_of(name, rotation_from_quaternion(unit_quaternion([w, x, y, z])), np.array(values[:3]))
    if len(values) == 6:  # yaw, pitch, roll
        return frame_of(name, convention("ZYX").to_rotation(np.array(values[3:])), np.array(values[:3]))
    raise FileFormatError(f"{len(values)} numbers", row=row, expected=_EXPECTED)


FORMAT = RosStatic()
