"""Writes an arm as a robot description."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.rotations import to_rpy


def write_arm(arm: Arm, path: Path) -> None:
    """A URDF without shapes: links with inertials, joints with limits, a last frame called tool0."""
    robot = ET.Element("robot", name=arm.name)
    ET.SubElement(robot, "link", name="base_link")
    for k in range(arm.n):
        link = ET.SubElement(robot, "link", name=f"link_{k + 1}")
        if arm.masses[k] > 0:
            inertial = ET.SubElement(link, "inertial")
            ET.SubElement(inertial, "origin", xyz=_text(arm.coms[k]), rpy="0 0 0")
            ET.SubElement(inertial, "mass", value=f"{arm.masses[k]:.9g}")
            i = arm.inertias[k]
            values = {"ixx": i[0, 0], "ixy": i[0, 1], "ixz": i[0, 2]}
            values |= {"iyy": i[1, 1], "iyz": i[1, 2], "izz": i[2, 2]}
            ET.SubElement(inertial, "inertia", {key: f"{value:.9g}" for key, value in values.items()})
    ET.SubElement(robot, "link", name="tool0")
    for k in range(arm.n + 1):
        last = k == arm.n
        kind = "fixed" if last else "prismatic" if arm.slides[k] else "revolute"
        joint = ET.SubElement(robot, "joint", name="flange" if last else f"joint_{k + 1}", type=kind)
        ET.SubElement(joint, "parent", link="base_link" if k == 0 else f"link_{k}")
        ET.SubElement(joint, "child", link="tool0" if last else f"link_{k + 1}")
        rpy = np.array(to_rpy(arm.rotations[k]))
        ET.SubElement(joint, "origin", xyz=_text(arm.translations[k]), rpy=_text(rpy))
        if not last:
            ET.SubElement(joint, "axis", xyz=_text(arm.axes[k]))
            ET.SubElement(
                joint,
                "limit",
                lower=f"{arm.lower[k]:.9g}",
                upper=f"{arm.upper[k]:.9g}",
                effort=f"{arm.effort[k]:.9g}",
                velocity=f"{arm.speed[k]:.9g}",
            )
    ET.indent(robot)
    ET.ElementTree(robot).write(path, encoding="utf-8", xml_declaration=True)


def _text(values: np.ndarray) -> str:
    return " ".join(f"{v:.12g}" for v in values)
