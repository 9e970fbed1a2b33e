"""ROS: the command that publishes a static transform (tf2_ros); metres, quaternion x y z w by name.

Read are the named form of ROS 2 and both forms of ROS 1: x y z yaw pitch roll, and x y z qx qy qz qw; on a command
line, also one that goes on after a backslash, or as `args` of a node in a launch file.
"""

from __future__ import annotations

import re

import numpy as np

from app.calibration.exchange._frame import ToolFrame, frame_of, number, row_of, unit_quaternion, written
from app.errors import FileFormatError
from app.geometry import convention, rotation_from_quaternion

_COMMAND = re.compile(
    r"""static_transform_publisher["']?(?:[ \t]+((?!name\s*=|args\s*=)[^\n>]*)|[^>]*?\bargs\s*=\s*["']([^"']*)["'])"""
)
_NAMED = re.compile(r"--([a-z-]+)[ =]+(\S+)")
_EXPECTED = "static_transform_publisher --x … --qw … --frame-id flange --child-frame-id tool"


class RosStatic:
    key = "ros_static"
    title = "ROS static transform"
    suffix = ".sh"

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

    def read(self, text: str) -> ToolFrame:
        found = _COMMAND.search(_joined(text))
        if not found:
            raise FileFormatError("no static transform", row=1, expected=_EXPECTED)
        row = row_of(text, found.start())
        arguments = found.group(1) or found.group(2) or ""
        named = dict(_NAMED.findall(arguments))
        if named:
            return _by_name(named, row)
        return _by_place(arguments.split(), row)


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


def _by_place(words: list[str], row: int) -> ToolFrame:
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
