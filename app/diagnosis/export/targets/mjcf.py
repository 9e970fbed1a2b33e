"""MuJoCo's own format. Everything that acts in a joint has its place here, delay and torque factor in the motor.

A motor's control is the torque as the recording counts it: its gain takes the torque factor out, its bias holds the
constant torque, its history holds the delay.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np

from app.diagnosis.export.arm import Left, SimArm, SimJoint, about_centre
from app.diagnosis.export.targets._words import joint_names, lateness, named, remark, said
from app.geometry import quaternion_from_rotation

#: Of the simulation [s].
_STEP = 0.001
#: Dry friction as a hard constraint: it holds its full value above about a thousandth of the joint's acceleration.
_HARD = {"solreffriction": "0.002 1", "solimpfriction": "0.9999 0.9999 0.001 0.5 2"}


class Mjcf:
    key = "mjcf"
    title = "MJCF"
    version = "MuJoCo 4.0"
    suffix = ".xml"

    def write(self, arm: SimArm) -> tuple[str, tuple[Left, ...]]:
        left: list[Left] = []
        root = ET.Element("mujoco", model=arm.name)
        root.append(ET.Comment(""))
        ET.SubElement(root, "compiler", angle="radian", autolimits="true")
        ET.SubElement(
            root, "option", gravity=said(arm.gravity), timestep=repr(_STEP), integrator="implicitfast"
        )
        body = ET.SubElement(ET.SubElement(root, "worldbody"), "body", name="base")
        names = joint_names(arm)
        for name, joint in zip(names, arm.joints, strict=True):
            body = _body(body, name, joint)
        rotation, position, flange = arm.flange
        ET.SubElement(
            body,
            "site",
            name=named(flange),
            pos=said(position),
            quat=said(quaternion_from_rotation(rotation)),
        )
        actuators = ET.SubElement(root, "actuator")
        late = max(arm.delay, 0.0)
        if arm.delay < 0.0:
            left.append(lateness(arm, "torques ahead of their motion have no actuator"))
        for name, joint in zip(names, arm.joints, strict=True):
            actuators.append(_motor(name, joint, late))
        root[0].text = "\n" + remark(arm, f"{self.title}, {self.version}", (*arm.left, *left)) + "\n"
        ET.indent(root)
        return ET.tostring(root, encoding="unicode") + "\n", tuple(left)


def _body(parent: ET.Element, name: str, joint: SimJoint) -> ET.Element:
    body = ET.SubElement(
        parent,
        "body",
        name=joint.body,
        pos=said(joint.position),
        quat=said(quaternion_from_rotation(joint.rotation)),
    )
    mass, centre, about = about_centre(joint.inertial)
    six = [about[0, 0], about[1, 1], about[2, 2], about[0, 1], about[0, 2], about[1, 2]]
    ET.SubElement(body, "inertial", pos=said(centre), mass=repr(mass), fullinertia=said(six))
    damping = [joint.damping, joint.damping2] if joint.damping2 else [joint.damping]
    acting = {
        "name": name,
        "type": "slide" if joint.prismatic else "hinge",
        "axis": said(joint.axis),
        "range": said([joint.lower, joint.upper]),
        "damping": said(damping),
        "armature": repr(joint.armature),
        "stiffness": repr(joint.stiffness),
        "frictionloss": repr(max(joint.friction, 0.0)),
    }
    ET.SubElement(body, "joint", acting | _HARD)
    length = float(np.linalg.norm(joint.position))
    if length > 1e-3:  # something to look at: a rod from the joint before to this one
        ET.SubElement(
            parent,
            "geom",
            type="capsule",
            fromto=said([0.0, 0.0, 0.0, *joint.position]),
            size=repr(max(0.02, 0.05 * length)),
            mass="0",
            contype="0",
            conaffinity="0",
        )
    return body


def _motor(name: str, joint: SimJoint, late: float) -> ET.Element:
    """Force on the joint = ctrl / gain - offset, `late` seconds after the control."""
    motor = ET.Element(
        "general",
        name=f"motor_{name}",
        joint=name,
        gaintype="fixed",
        gainprm=repr(1.0 / joint.gain),
        biastype="affine",
        biasprm=said([-joint.offset, 0.0, 0.0]),
    )
    if joint.effort > 0.0:
        motor.set("forcerange", said([-joint.effort, joint.effort]))
    if late > 0.0:
        motor.set("delay", repr(late))
        motor.set("nsample", str(math.ceil(late / _STEP) + 2))
    return motor


TARGET = Mjcf()
