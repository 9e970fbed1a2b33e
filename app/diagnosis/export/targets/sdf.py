"""SDFormat, as Gazebo and Drake read it: a world with its gravity and the arm in it."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from app.diagnosis.export.arm import Left, SimArm, SimJoint, about_centre
from app.diagnosis.export.targets._words import joint_names, lateness, lost, named, remark, said
from app.geometry import convention

_VERSION = "1.11"
_NO_WORD = "SDFormat has no word for it"


class Sdf:
    key = "sdf"
    title = "SDFormat"
    version = f"{_VERSION} (Gazebo Harmonic and later, Drake)"
    suffix = ".sdf"

    def write(self, arm: SimArm) -> tuple[str, tuple[Left, ...]]:
        left = lost(arm, ("armature", "damping2", "gain"), _NO_WORD)
        left += [
            Left(f"constant torque (joint {k})", f"{j.offset:.6g} Nm", "no spring that could hold it")
            for k, j in enumerate(arm.joints, 1)
            if j.offset and not j.stiffness
        ]
        if arm.delay:
            left.append(lateness(arm, _NO_WORD))
        root = ET.Element("sdf", version=_VERSION)
        root.append(ET.Comment("\n" + remark(arm, f"{self.title} {self.version}", (*arm.left, *left)) + "\n"))
        world = ET.SubElement(root, "world", name="teachframe")
        ET.SubElement(world, "gravity").text = said(arm.gravity)
        model = ET.SubElement(world, "model", name=arm.name)
        base = ET.SubElement(model, "link", name="base")
        _inertial(base, 1.0, [0.0] * 3, [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]])
        fixed = ET.SubElement(model, "joint", name="on_the_ground", type="fixed")
        ET.SubElement(fixed, "parent").text = "world"
        ET.SubElement(fixed, "child").text = "base"
        parent = "base"
        for name, joint in zip(joint_names(arm), arm.joints, strict=True):
            _link(model, parent, joint)
            _joint(model, name, parent, joint)
            parent = joint.body
        rotation, position, flange = arm.flange
        frame = ET.SubElement(model, "frame", name=named(flange), attached_to=parent)
        _pose(frame, position, rotation)
        ET.indent(root)
        return f'<?xml version="1.0"?>\n{ET.tostring(root, encoding="unicode")}\n', tuple(left)


def _pose(element: ET.Element, position, rotation, **where: str) -> None:
    pose = ET.SubElement(element, "pose", {"rotation_format": "euler_rpy", **where})
    pose.text = said([*position, *convention("ZYX").from_rotation(rotation)[::-1]])


def _inertial(link: ET.Element, mass: float, centre, about) -> None:
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "pose").text = said([*centre, 0.0, 0.0, 0.0])
    ET.SubElement(inertial, "mass").text = repr(mass)
    six = ET.SubElement(inertial, "inertia")
    for i in range(3):
        for j in range(i, 3):
            ET.SubElement(six, f"i{'xyz'[i]}{'xyz'[j]}").text = repr(float(about[i][j]))


def _link(model: ET.Element, parent: str, joint: SimJoint) -> None:
    link = ET.SubElement(model, "link", name=joint.body)
    _pose(link, joint.position, joint.rotation, relative_to=parent)
    _inertial(link, *about_centre(joint.inertial))


def _joint(model: ET.Element, name: str, parent: str, joint: SimJoint) -> None:
    element = ET.SubElement(model, "joint", name=name, type="prismatic" if joint.prismatic else "revolute")
    ET.SubElement(element, "parent").text = parent
    ET.SubElement(element, "child").text = joint.body
    axis = ET.SubElement(element, "axis")
    ET.SubElement(axis, "xyz").text = said(joint.axis)
    limit = ET.SubElement(axis, "limit")
    for key, value in (("lower", joint.lower), ("upper", joint.upper)):
        ET.SubElement(limit, key).text = repr(float(value))
    for key, value in (("effort", joint.effort), ("velocity", joint.velocity)):
        if value > 0.0:
            ET.SubElement(limit, key).text = repr(float(value))
    dynamics = ET.SubElement(axis, "dynamics")
    reference = -joint.offset / joint.stiffness if joint.stiffness else 0.0
    for key, value in (
        ("damping", joint.damping),
        ("friction", joint.friction),
        ("spring_reference", reference),
        ("spring_stiffness", joint.stiffness),
    ):
        ET.SubElement(dynamics, key).text = repr(float(value))


TARGET = Sdf()
