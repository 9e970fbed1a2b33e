"""URDF or xacro: a fixed joint from the flange to the tool; metres, rpy about fixed axes."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

from app.calibration.exchange._frame import ToolFrame, frame_of, number, written
from app.errors import FileFormatError
from app.geometry import convention

_SHAPE = '<joint type="fixed"> with <parent>, <child> and <origin xyz rpy>'


class UrdfJoint:
    key = "urdf_joint"
    title = "URDF/xacro fixed joint"
    suffix = ".urdf.xacro"

    def knows(self, text: str) -> bool:
        return "<joint" in text and "fixed" in text

    def write(self, frame: ToolFrame) -> str:
        xyz = " ".join(written(v, 10) for v in frame.pose.position)
        rpy = " ".join(written(v, 12) for v in convention("XYZ").from_rotation(frame.pose.rotation))
        return (
            f'<robot name="{frame.name}">\n'
            '  <link name="flange"/>\n'
            f'  <link name="{frame.name}"/>\n'
            f'  <joint name="flange_to_{frame.name}" type="fixed">\n'
            '    <parent link="flange"/>\n'
            f'    <child link="{frame.name}"/>\n'
            f'    <origin xyz="{xyz}" rpy="{rpy}"/>\n'
            "  </joint>\n"
            "</robot>\n"
        )

    def read(self, text: str) -> ToolFrame:
        if "<!ENTITY" in text or "<!DOCTYPE" in text:
            raise FileFormatError("declares entities", row=1, expected=_SHAPE)
        try:
            root = ET.fromstring(text)
        except (ET.ParseError, ValueError, RecursionError) as error:
            raise FileFormatError(f"not XML ({error})", expected=_SHAPE) from None
        joints = [j for j in root.iter("joint") if j.get("type") == "fixed" and j.find("origin") is not None]
        if not joints:
            raise FileFormatError("no fixed joint with an origin", row=1, expected=_SHAPE)
        joint = joints[-1]  # the last one in a chain is the tool's
        origin, child = joint.find("origin"), joint.find("child")
        assert origin is not None
        xyz, rpy = _three(origin, "xyz"), _three(origin, "rpy")
        name = child.get("link", "tool") if child is not None else "tool"
        return frame_of(name, convention("XYZ").to_rotation(rpy), xyz)


def _three(element: ET.Element, key: str) -> np.ndarray:
    words = element.get(key, "0 0 0").split()
    if len(words) != 3:
        raise FileFormatError(f"{len(words)} numbers", column=key, expected="3 numbers")
    return np.array([number(word, None, key) for word in words])


FORMAT = UrdfJoint()
