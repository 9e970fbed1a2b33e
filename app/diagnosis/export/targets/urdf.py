"""URDF: the chain from base to flange with what was found in it.

`diagnose --save-urdf` keeps the person's own file, links and meshes as they are, and writes what fits into that.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

from app.diagnosis.export.arm import Left, SimArm, SimJoint, about_centre
from app.diagnosis.export.targets._words import joint_names, lateness, lost, named, remark, said
from app.geometry import convention

_NO_WORD = "URDF has no word for it"


class Urdf:
    key = "urdf"
    title = "URDF"
    version = "ROS 1 and 2, urdfdom 1.0"
    suffix = ".urdf"

    def write(self, arm: SimArm) -> tuple[str, tuple[Left, ...]]:
        left = [
            *lost(arm, ("armature", "damping2", "stiffness", "offset", "gain"), _NO_WORD),
            *_world(arm, _NO_WORD),
        ]
        root = ET.Element("robot", name=arm.name)
        root.append(
            ET.Comment("\n" + remark(arm, f"{self.title}, {self.version}", (*arm.left, *left)) + "\n")
        )
        ET.SubElement(root, "link", name="base")
        parent = "base"
        for name, joint in zip(joint_names(arm), arm.joints, strict=True):
            _link(root, joint)
            _joint(root, name, parent, joint)
            parent = joint.body
        rotation, position, flange = arm.flange
        name = named(flange)
        ET.SubElement(root, "link", name=name)
        fixed = ET.SubElement(root, "joint", name=f"{parent}_{name}", type="fixed")
        _ends(fixed, parent, name)
        ET.SubElement(fixed, "origin", xyz=said(position), rpy=said(_rpy(rotation)))
        ET.indent(root)
        text = ET.tostring(root, encoding="unicode", xml_declaration=False)
        return f'<?xml version="1.0"?>\n{text}\n', tuple(left)


def _world(arm: SimArm, why: str) -> list[Left]:
    """What belongs to the surroundings and not to the arm."""
    out = []
    if arm.delay:
        out.append(lateness(arm, why))
    if abs(arm.gravity[0]) + abs(arm.gravity[1]) + abs(arm.gravity[2] + 9.81) > 1e-9:
        out.append(Left("gravity in base", ", ".join(f"{v:.5g}" for v in arm.gravity) + " m/s^2", why))
    return out


def _rpy(rotation):
    return convention("ZYX").from_rotation(rotation)[::-1]


def _ends(element: ET.Element, parent: str, child: str) -> None:
    ET.SubElement(element, "parent", link=parent)
    ET.SubElement(element, "child", link=child)


def _link(root: ET.Element, joint: SimJoint) -> None:
    mass, centre, about = about_centre(joint.inertial)
    inertial = ET.SubElement(ET.SubElement(root, "link", name=joint.body), "inertial")
    ET.SubElement(inertial, "origin", xyz=said(centre), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=repr(mass))
    six = {f"i{'xyz'[i]}{'xyz'[j]}": repr(float(about[i, j])) for i in range(3) for j in range(i, 3)}
    ET.SubElement(inertial, "inertia", six)


def _joint(root: ET.Element, name: str, parent: str, joint: SimJoint) -> None:
    element = ET.SubElement(root, "joint", name=name, type="prismatic" if joint.prismatic else "revolute")
    _ends(element, parent, joint.body)
    ET.SubElement(element, "origin", xyz=said(joint.position), rpy=said(_rpy(joint.rotation)))
    ET.SubElement(element, "axis", xyz=said(joint.axis))
    limits = {"lower": joint.lower, "upper": joint.upper, "velocity": joint.velocity, "effort": joint.effort}
    ET.SubElement(element, "limit", {key: repr(float(value)) for key, value in limits.items()})
    if joint.damping or joint.friction:
        ET.SubElement(element, "dynamics", damping=repr(joint.damping), friction=repr(joint.friction))


TARGET = Urdf()
