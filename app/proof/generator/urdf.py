"""Reads a robot description with nothing but the XML parser of the standard library."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from app import catalog, resources
from app.errors import FileFormatError, UnknownNameError
from app.proof.generator.arm import Arm
from app.proof.generator.rotations import from_rpy

TIPS = ("tool0", "flange", "ee_link")
MOVING = ("revolute", "continuous", "prismatic")


def find_robot(name: str) -> Path:
    """The URDF of a shipped robot, or a path as it is.

    Raises:
        UnknownNameError: neither.
    """
    shipped = catalog.folders(resources.ROBOTS, "robot.toml")
    if name in shipped:
        return shipped[name] / "robot.urdf"
    path = Path(name)
    if not path.is_file():
        raise UnknownNameError(name, available=shipped, what="robot (and no such file)")
    return path


def read_arm(path: Path, plain: str | None = None, flange: str | None = None) -> Arm:
    """The chain with most moving joints, to a frame called tool0, flange or ee_link where one ends it.

    Args:
        path: the URDF.
        plain: a URDF in which only the arm's joints move, in place of what the file holds.
        flange: the link that ends the chain.

    Raises:
        FileFormatError: not a description of a serial arm.
    """
    try:
        root = ET.parse(path).getroot() if plain is None else ET.fromstring(plain)
    except (OSError, ET.ParseError, ValueError) as error:
        raise FileFormatError(f"not a robot description ({error})", file=path, expected="URDF") from None
    by_child = {_attribute(j, "child", "link"): j for j in root.findall("joint")}
    chains = {}
    for link in root.findall("link"):
        chain, tip = [], link.get("name", "")
        while tip in by_child and len(chain) <= len(by_child):
            chain.append(by_child[tip])
            tip = _attribute(by_child[tip], "parent", "link")
        chains[link.get("name", "")] = chain[::-1]
    count = {name: sum(j.get("type") in MOVING for j in chain) for name, chain in chains.items()}
    most = max(count.values(), default=0) if flange is None else count.get(flange, 0)
    if most < 1:
        raise FileFormatError(f"{most} moving joints in a row", file=path, expected="1 or more")
    if any(j.find("mimic") is not None and j.get("type") in MOVING for j in root.findall("joint")):
        raise FileFormatError(
            "a joint follows another, which no recording is made of",
            file=path,
            expected="an arm without <mimic>",
        )
    longest = [name for name in chains if count[name] == most]
    named = [tip for tip in TIPS if tip in longest]
    tip = flange or (named[0] if named else max(longest, key=lambda name: len(chains[name])))
    try:
        return _arm(root, chains[tip], path.stem)
    except (ValueError, AttributeError) as error:
        raise FileFormatError(
            f"a number cannot be read ({error})", file=path, expected="numbers in URDF"
        ) from None


def _arm(root: ET.Element, chain: list[ET.Element], name: str) -> Arm:
    rotations, translations, axes, slides, limits, links = [], [], [], [], [], []
    rotation, place = np.eye(3), np.zeros(3)
    for joint in chain:
        inner, offset = _origin(joint)
        place, rotation = place + rotation @ offset, rotation @ inner
        if joint.get("type") not in MOVING:
            continue
        axis = joint.find("axis")
        direction = _numbers(axis.get("xyz") if axis is not None else None, [1.0, 0.0, 0.0])
        rotations.append(rotation)
        translations.append(place)
        axes.append(direction / np.linalg.norm(direction))
        slides.append(joint.get("type") == "prismatic")
        limit = joint.find("limit")
        endless = joint.get("type") == "continuous" or limit is None
        low, high = (-2 * np.pi, 2 * np.pi)
        if not endless and limit is not None:
            low, high = float(limit.get("lower", low)), float(limit.get("upper", high))
        speed = float(limit.get("velocity", 0.0)) if limit is not None else 0.0
        effort = float(limit.get("effort", 0.0)) if limit is not None else 0.0
        limits.append((low, high, speed, effort))
        links.append(_attribute(joint, "child", "link"))
        rotation, place = np.eye(3), np.zeros(3)
    rotations.append(rotation)
    translations.append(place)
    low, high, speed, effort = np.array(limits).T
    bodies = [_body(root, link, set(links)) for link in links]
    return Arm(
        name,
        np.array(rotations),
        np.array(translations),
        np.array(axes),
        np.array(slides),
        low,
        high,
        speed,
        effort,
        np.array([b[0] for b in bodies]),
        np.array([b[1] for b in bodies]),
        np.array([b[2] for b in bodies]),
    )


def _attribute(element: ET.Element, child: str, key: str) -> str:
    found = element.find(child)
    return "" if found is None else found.get(key, "")


def _numbers(text: str | None, default: list[float]) -> np.ndarray:
    return np.array([float(v) for v in text.split()] if text else default)


def _origin(element: ET.Element) -> tuple[np.ndarray, np.ndarray]:
    origin = element.find("origin")
    if origin is None:
        return np.eye(3), np.zeros(3)
    rpy = _numbers(origin.get("rpy"), [0.0, 0.0, 0.0])
    return from_rpy(*rpy), _numbers(origin.get("xyz"), [0.0, 0.0, 0.0])


def _body(root: ET.Element, link: str, chain: set[str]) -> tuple[float, np.ndarray, np.ndarray]:
    """Mass, centre and inertia about the centre of a link and of all that hangs on it.

    What moves beside the chain (grippers) is taken at zero; the chain's own next link is not followed.
    """
    parts: list[tuple[float, np.ndarray, np.ndarray]] = []

    def collect(name: str, rotation: np.ndarray, place: np.ndarray) -> None:
        element = next((e for e in root.findall("link") if e.get("name") == name), None)
        inertial = None if element is None else element.find("inertial")
        if inertial is not None:
            inner, offset = _origin(inertial)
            mass = float(_attribute(inertial, "mass", "value") or 0.0)
            i = inertial.find("inertia")
            v = {k: float(i.get(k, 0.0)) if i is not None else 0.0 for k in _INERTIA}
            own = np.array(
                [
                    [v["ixx"], v["ixy"], v["ixz"]],
                    [v["ixy"], v["iyy"], v["iyz"]],
                    [v["ixz"], v["iyz"], v["izz"]],
                ]
            )
            axes = rotation @ inner
            parts.append((mass, place + rotation @ offset, axes @ own @ axes.T))
        for joint in root.findall("joint"):
            child = _attribute(joint, "child", "link")
            if _attribute(joint, "parent", "link") == name and child not in chain:
                inner, offset = _origin(joint)
                collect(child, rotation @ inner, place + rotation @ offset)

    collect(link, np.eye(3), np.zeros(3))
    mass = sum(p[0] for p in parts)
    if mass <= 0:
        return 0.0, np.zeros(3), np.zeros((3, 3))
    centre = sum((p[0] * p[1] for p in parts), np.zeros(3)) / mass
    total = np.zeros((3, 3))
    for part_mass, part_place, part_inertia in parts:
        lever = part_place - centre
        total += part_inertia + part_mass * (lever @ lever * np.eye(3) - np.outer(lever, lever))
    return float(mass), centre, total


_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
