"""URDF or xacro: a fixed joint from the flange to the tool; metres, rpy about fixed axes.

Xacro's expressions are understood where they hold numbers, pi and radians(…) only.
"""

from __future__ import annotations

import ast
import math
import operator
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from functools import partial

import numpy as np

from app.calibration.exchange._frame import ToolFrame, frame_of, number, written
from app.calibration.exchange._tools import Reader, Tool, all_zero
from app.errors import FileFormatError
from app.geometry import convention

_SHAPE = '<joint type="fixed"> with <parent>, <child> and <origin xyz rpy>'

_WORD = re.compile(r"\$\{[^}]{0,200}\}|\S+")
_SIGNS: dict[type, Callable[[float], float]] = {ast.USub: operator.neg, ast.UAdd: operator.pos}
_OPERATIONS: dict[type, Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


class UrdfJoint(Reader):
    key = "urdf_joint"
    title = "URDF/xacro fixed joint"
    suffix = ".urdf.xacro"
    suffixes = (".urdf", ".xacro")
    lacks = "it has no fixed joint"
    absent = _SHAPE

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

    def tools(self, text: str) -> list[Tool]:
        if "<!ENTITY" in text or "<!DOCTYPE" in text:
            raise FileFormatError("declares entities", row=1, expected=_SHAPE)
        try:
            root = ET.fromstring(text)
        except (ET.ParseError, ValueError, RecursionError) as error:
            raise FileFormatError(f"not XML ({error})", expected=_SHAPE) from None
        joints = [j for j in root.iter("joint") if j.get("type") == "fixed" and j.find("origin") is not None]
        if not joints:
            raise FileFormatError("no fixed joint with an origin", row=1, expected=_SHAPE)
        tools = []
        for joint in joints:
            origin, child = joint.find("origin"), joint.find("child")
            assert origin is not None
            name = child.get("link", "tool") if child is not None else "tool"
            words = (origin.get("xyz", "0 0 0"), origin.get("rpy", "0 0 0"))
            bare = "${" not in "".join(words) and all_zero(words)
            tools.append(Tool(name, 0, 1, words, bare, partial(_frame, name, origin)))
        return tools


def _frame(name: str, origin: ET.Element) -> ToolFrame:
    xyz, rpy = _three(origin, "xyz"), _three(origin, "rpy")
    return frame_of(name, convention("XYZ").to_rotation(rpy), xyz)


def _three(element: ET.Element, key: str) -> np.ndarray:
    words = _WORD.findall(element.get(key, "0 0 0"))
    if len(words) != 3:
        raise FileFormatError(f"{len(words)} numbers", column=key, expected="3 numbers")
    return np.array([_value(word, key) for word in words])


def _value(word: str, key: str) -> float:
    """A number, or one of xacro's expressions of numbers and pi: `${-pi/2}`."""
    if not word.startswith("${"):
        return number(word, None, key)
    try:
        return number(repr(_worked_out(ast.parse(word[2:-1].strip(), mode="eval").body)), None, key)
    except (SyntaxError, ValueError, ZeroDivisionError, OverflowError, RecursionError, MemoryError):
        raise FileFormatError(
            f"found {word[:40]!r}", column=key, expected="a number, or ${…} of numbers and pi"
        ) from None


def _worked_out(node: ast.expr) -> float:
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        return float(node.value)
    if isinstance(node, ast.Name) and node.id == "pi":
        return math.pi
    if isinstance(node, ast.UnaryOp) and type(node.op) in _SIGNS:
        return _SIGNS[type(node.op)](_worked_out(node.operand))
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATIONS:
        return _OPERATIONS[type(node.op)](_worked_out(node.left), _worked_out(node.right))
    if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "radians" and len(node.args) == 1:
        return math.radians(_worked_out(node.args[0]))
    raise ValueError("not an expression of numbers")


FORMAT = UrdfJoint()
