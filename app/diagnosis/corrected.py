"""A corrected robot description: those findings that a URDF has words for, written into it."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from copy import deepcopy
from pathlib import Path

import numpy as np

from app.diagnosis import effects
from app.diagnosis.effects.described import Body, Change, InJoint, Placed
from app.diagnosis.model import ModelEffect, SavedModel
from app.errors import InputError
from app.files import write_bytes
from app.geometry import convention, exp_so3
from app.kinematics import RobotModel

#: What `<dynamics>` of a joint holds.
_DYNAMICS = {"damping", "friction"}


def save_corrected_urdf(
    robot: RobotModel, model: SavedModel, path: str | Path, *, strict: bool = True
) -> tuple[str, ...]:
    """Writes the description with the model's effects in it.

    Zeros, lengths and twists become placements of joints, a payload becomes mass of the flange's link, friction
    becomes the joint's `<dynamics>`. What moves with load, time or direction has no word in a URDF.

    Args:
        strict: False writes the description also where nothing of the model has a word in it.

    Returns:
        One line for each effect that was left out.

    Raises:
        InputError: nothing of the model can be written, or the file cannot.
    """
    root = _description(robot)
    left_out = [e for e in model.effects if not _written(root, robot, e, model.kind)]
    if strict and len(left_out) == len(model.effects):
        raise InputError(
            "none of what was found has a word in a URDF: " + ", ".join(e.effect for e in left_out),
            expected="--save-model, which holds every effect",
        )
    write_bytes(path, ET.tostring(root, encoding="utf-8", xml_declaration=True))
    return tuple(f"not in the description, a URDF has no word for it: {e.effect}" for e in left_out)


def _description(robot: RobotModel) -> ET.Element:
    """A copy of the file's own elements; of a macro, a table, a calibrated arm what was made of it."""
    plain = robot.path.suffix == ".urdf" and "#calibration=" not in robot.address
    try:
        root = ET.parse(robot.path).getroot() if plain else None
    except ET.ParseError:  # a simulator's prefix that nobody declared
        root = None
    if root is None or root.find("joint") is None:  # macros that make the joints
        root = deepcopy(robot.source)
    assert root is not None  # every robot that was loaded has one
    return root


def _written(root: ET.Element, robot: RobotModel, effect: ModelEffect, kind: str) -> bool:
    """True where every part of the effect has a word, and it is written."""
    law = effects.named(effect.effect, kind)
    if law is None or not effect.parameters:
        return False
    changes = law.described(robot, effect.where, effect.parameters)
    return bool(changes) and all(_put(root, robot, change) for change in changes)


def _put(root: ET.Element, robot: RobotModel, change: Change) -> bool:
    if isinstance(change, Placed):
        return _place(root, robot, change)
    if isinstance(change, Body):
        return _body(root, robot, change)
    if isinstance(change, InJoint) and change.more.keys() <= _DYNAMICS:
        return _dynamics(root, robot, change)
    return False


def _place(root: ET.Element, robot: RobotModel, change: Placed) -> bool:
    """origin -> origin @ Trans(shift) @ Rot(turn)."""
    joint = _joint_element(root, robot, change.joint - 1)
    if joint is None:
        return False
    origin = joint.find("origin")
    if origin is None:
        origin = ET.SubElement(joint, "origin")
    angles = convention("ZYX")  # rpy backwards: Rz(yaw) Ry(pitch) Rx(roll)
    position = _triple(origin.get("xyz"))
    rotation = angles.to_rotation(_triple(origin.get("rpy"))[::-1])
    if change.shift is not None:
        position = position + rotation @ change.shift
    if change.turn is not None:
        rotation = rotation @ exp_so3(change.turn)
    origin.set("xyz", _said(position))
    origin.set("rpy", _said(angles.from_rotation(rotation)[::-1]))
    return True


def _joint_element(root: ET.Element, robot: RobotModel, index: int) -> ET.Element | None:
    """The moving joint's element; past the last the one that carries the flange, if it is fixed."""
    for joint in root.findall("joint"):
        if index < robot.joint_count:
            if joint.get("name") == robot.joints[index].name:
                return joint
            continue
        child = joint.find("child")
        if child is not None and child.get("link") == robot.flange and joint.get("type") == "fixed":
            return joint
    return None


def _body(root: ET.Element, robot: RobotModel, change: Body) -> bool:
    """A point mass added to the flange's link, or to the one it is said to be on, by the parallel-axis theorem."""
    mass, at, name = change.mass, change.centre, robot.flange
    if change.link is not None:
        joint = _joint_element(root, robot, change.link - 1)
        child = None if joint is None else joint.find("child")
        name = "" if child is None else child.get("link", "")
    link = next((e for e in root.findall("link") if e.get("name") == name), None)
    if link is None or mass <= 0:
        return False
    inertial = link.find("inertial")
    if inertial is None:
        inertial = ET.SubElement(link, "inertial")
    parts = {name: _child(inertial, name) for name in ("origin", "mass", "inertia")}
    if np.any(_triple(parts["origin"].get("rpy"))):
        return False
    old_mass = float(parts["mass"].get("value", "0"))
    old_at = _triple(parts["origin"].get("xyz"))
    total = old_mass + mass
    centre = (old_mass * old_at + mass * at) / total
    inertia = _inertia(parts["inertia"]) + _point(old_mass, old_at - centre) + _point(mass, at - centre)
    parts["mass"].set("value", f"{total:.12g}")
    parts["origin"].set("xyz", _said(centre))
    for i, a in enumerate("xyz"):
        for j in range(i, 3):
            parts["inertia"].set(f"i{a}{'xyz'[j]}", f"{inertia[i, j]:.12g}")
    return True


def _dynamics(root: ET.Element, robot: RobotModel, change: InJoint) -> bool:
    joint = _joint_element(root, robot, change.joint - 1)
    if joint is None:
        return False
    element = _child(joint, "dynamics")
    for key, more in change.more.items():
        element.set(key, f"{float(element.get(key, '0')) + more:.12g}")
    return True


def _child(parent: ET.Element, name: str) -> ET.Element:
    found = parent.find(name)
    return ET.SubElement(parent, name) if found is None else found


def _triple(text: str | None) -> np.ndarray:
    return np.array([float(v) for v in (text or "0 0 0").split()])


def _said(values: np.ndarray) -> str:
    return " ".join(f"{v:.12g}" for v in values)


def _inertia(element: ET.Element) -> np.ndarray:
    upper = np.zeros((3, 3))
    for i, a in enumerate("xyz"):
        for j in range(i, 3):
            upper[i, j] = upper[j, i] = float(element.get(f"i{a}{'xyz'[j]}", "0"))
    return upper


def _point(mass: float, at: np.ndarray) -> np.ndarray:
    """Inertia of a point mass about the origin."""
    return mass * (at @ at * np.eye(3) - np.outer(at, at))
