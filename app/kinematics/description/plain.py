"""The arm alone as a small URDF: what pin builds, what the case generator reads.

Links and joints keep their names. What moves beside the arm (grippers, heads) is fixed where it stands at zero, solids
and meshes are left out, and links that neither carry a mass nor lead to the flange are dropped.
"""

from __future__ import annotations

import copy
import math
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

from app.errors import FileFormatError
from app.kinematics.description.arm import Arm
from app.kinematics.description.checked import NUMBERS
from app.kinematics.description.tree import JointElement, LinkTree

#: A continuous joint becomes a revolute one of two turns either way, so that one number is its angle [rad].
TWO_TURNS = 12.566370614359172
_FAR = 1e3  # m: a slide without an end


def plain_urdf(tree: LinkTree, arm: Arm) -> ET.Element:
    """The description with the arm's joints moving and all others fixed.

    Raises:
        FileFormatError: an arm joint without limits, or with crossed ones.
    """
    root = ET.Element("robot", {"name": "arm"})
    own = {joint.name for joint in arm.chain}
    joints = _needed(tree, arm, own)
    names = [arm.base, *(joint.child for joint in joints)]
    for name in names:
        link = ET.SubElement(root, "link", {"name": name})
        inertial = tree.links[name].find("inertial")
        if inertial is not None and inertial.find("mass") is not None:
            link.append(_whole(inertial))
    followers = {joint.name for joint in arm.following}
    for joint in joints:
        moves = joint.moves and joint.name in own
        root.append(_joint(joint, tree.path, moves=moves, follows=joint.name in followers))
    for element in root.iter():
        for key, _, _ in NUMBERS.get(element.tag, ()):
            if key in element.attrib:
                element.set(key, " ".join(_written(float(word)) for word in element.get(key, "").split()))
    return root


def _written(value: float) -> str:
    """A number as the parser below reads it; it knows none that have no exponent left."""
    return repr(value if abs(value) >= sys.float_info.min else 0.0)


def _whole(inertial: ET.Element) -> ET.Element:
    """An inertial with every number it has to have: the parser below speaks to the terminal of those that lack."""
    out = copy.deepcopy(inertial)
    mass, inertia = out.find("mass"), out.find("inertia")
    assert mass is not None
    mass.attrib.setdefault("value", "0")
    if inertia is None:
        inertia = ET.SubElement(out, "inertia")
    for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
        inertia.attrib.setdefault(key, "0")
    return out


def _needed(tree: LinkTree, arm: Arm, own: set[str]) -> list[JointElement]:
    """Joints of the arm, and those that lead from it to a mass."""
    order: list[JointElement] = []
    edge = [arm.base]
    while edge:
        for joint in tree.below.get(edge.pop(), []):
            order.append(joint)
            edge.append(joint.child)
    wanted = {joint.child for joint in arm.chain}
    kept: list[JointElement] = []
    for joint in reversed(order):
        massive = tree.links[joint.child].find("inertial/mass") is not None
        if joint.name in own or massive or joint.child in wanted:
            wanted.add(joint.parent)
            kept.append(joint)
    return kept[::-1]


def _joint(joint: JointElement, path: Path, *, moves: bool, follows: bool) -> ET.Element:
    kind = ("prismatic" if joint.kind == "prismatic" else "revolute") if moves else "fixed"
    out = ET.Element("joint", {"name": joint.name, "type": kind})
    ET.SubElement(out, "parent", {"link": joint.parent})
    ET.SubElement(out, "child", {"link": joint.child})
    origin, axis = joint.element.find("origin"), joint.element.find("axis")
    if origin is not None:
        out.append(copy.deepcopy(origin))
    if not moves:
        return out
    ET.SubElement(out, "axis", {"xyz": "1 0 0" if axis is None else axis.get("xyz", "1 0 0")})
    out.append(_limit(joint, path, follows))
    if follows:
        mimic = joint.element.find("mimic")
        assert mimic is not None
        out.append(copy.deepcopy(mimic))
    return out


def _limit(joint: JointElement, path: Path, follows: bool) -> ET.Element:
    stated = joint.element.find("limit")
    if stated is None and joint.kind != "continuous" and not follows:
        raise FileFormatError(
            f"joint {joint.name!r} has no limits", file=path, expected="<limit lower upper …>"
        )
    values = {"effort": "0", "velocity": "0", "lower": "0", "upper": "0"}
    values |= {key: stated.get(key, "0") for key in values} if stated is not None else {}
    endless = TWO_TURNS if joint.kind != "prismatic" else _FAR
    for key, none in (("effort", 0.0), ("velocity", 0.0), ("lower", -endless), ("upper", endless)):
        if math.isinf(float(values[key])):
            values[key] = repr(none)
    if joint.kind == "continuous" or (stated is None and follows):
        values |= {"lower": str(-TWO_TURNS), "upper": str(TWO_TURNS)}
    if float(values["lower"]) > float(values["upper"]):
        raise FileFormatError(
            f"the limits of joint {joint.name!r} are crossed: {values['lower'][:20]} to {values['upper'][:20]}",
            file=path,
            expected="lower below upper",
        )
    return ET.Element("limit", values)
