"""Universal Robots' calibration of one arm, put into the description of its model.

Two files hold it: the controller's `calibration.conf`, differences to the model's DH rows

    [mounting]
    delta_theta = [ -8.4e-05, ...]      delta_a, delta_d [m], delta_alpha [rad]

and the `kinematics:` YAML that `ur_calibration` reads from a controller: where each joint stands on the link
before it. Both give the axis of every joint. Joints 2 to 4 are nearly parallel, so a controller may put their feet
tens of metres along the axis. A frame slid along its own axis moves nothing: each is slid to where it is nearest to
the model's, and so links keep their frames, masses and solids.

The file itself names no model. It is known by the name the arm was asked for, by the description's own name, else by
its axes: the description's lie on the model's.

Source: Universal Robots, "DH parameters for calculations of kinematics and dynamics" (universal-robots.com/articles,
the tables of all models named below).
"""

from __future__ import annotations

import configparser
import copy
import json
import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import yaml

from app.errors import CellValueError, FileFormatError, UnknownNameError
from app.geometry.pose import Pose
from app.geometry.rotation import rot_x, rot_z
from app.kinematics.description.dhtable import DhRow, dh_description
from app.kinematics.description.placing import origin_element, origin_pose, pose_of

_LARGEST = 100_000  # bytes
_FARTHEST = 0.1  # m: an axis that far off is not this model's
_ALIKE = (
    0.005,
    0.01,
)  # m, rad: as far as a description's axes may lie from the model's; models are 12 mm apart or more
_RIGHT = math.pi / 2
_ALPHA = (_RIGHT, 0.0, 0.0, _RIGHT, -_RIGHT, 0.0)
#: Model -> d1, a2, a3, d4, d5, d6 [m].
MODELS = {
    "ur3": (0.1519, -0.24365, -0.21325, 0.11235, 0.08535, 0.0819),
    "ur5": (0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823),
    "ur10": (0.1273, -0.612, -0.5723, 0.163941, 0.1157, 0.0922),
    "ur3e": (0.15185, -0.24355, -0.2132, 0.13105, 0.08535, 0.0921),
    "ur5e": (0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996),
    "ur10e": (0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655),
    "ur16e": (0.1807, -0.4784, -0.36, 0.17415, 0.11985, 0.11655),
    "ur20": (0.2363, -0.8620, -0.7287, 0.2010, 0.1593, 0.1543),
    "ur30": (0.2363, -0.6370, -0.5037, 0.2010, 0.1593, 0.1543),
}
_LINKS = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
_DELTAS = ("delta_a", "delta_alpha", "delta_d", "delta_theta")


def nominal_rows(model: str, file: Path | None) -> list[DhRow]:
    """The model's DH rows; raises UnknownNameError."""
    if model not in MODELS:
        raise UnknownNameError(model, available=MODELS, what="UR model", file=file)
    d1, a2, a3, d4, d5, d6 = MODELS[model]
    d, a = (d1, 0.0, 0.0, d4, d5, d6), (0.0, a2, a3, 0.0, 0.0, 0.0)
    return [DhRow(*row, 0.0) for row in zip(a, _ALPHA, d, strict=True)]


def bare_arm(model: str) -> ET.Element:
    """The arm that the maker's table describes, without masses and shapes; raises UnknownNameError."""
    return dh_description(nominal_rows(model, None))


def model_of(name: str, description: ET.Element, file: Path) -> str:
    """Which model a description is of: by a name, else by where its axes lie.

    Args:
        name: what the arm was asked for, or its file's stem.
        description: its base in DH frame 0.
        file: the calibration, for the message.

    Raises:
        FileFormatError: of none.
    """
    for said in (name, description.get("name", "")):
        parts = re.split(r"[^a-z0-9]+", said.lower())
        found = [model for model in MODELS if model in parts]
        if len(found) == 1:
            return found[0]
    moving, place, lines = _moving(description, file), Pose.identity(), []
    for joint in moving:
        place = place @ origin_pose(joint)
        lines.append((place.position, place.rotation @ _axis(joint)))
    for model in MODELS:
        nominal = _dh_axes(nominal_rows(model, file))
        if all(_on_line(axis, *line) for axis, line in zip(nominal, lines, strict=False)):
            return model
    raise FileFormatError(
        f"the arm {name[:40]!r} has the axes of no model of Universal Robots",
        file=file,
        expected=f"--robot {'|'.join(MODELS)}, or a description of one of them",
    )


def _on_line(axis: Pose, point: np.ndarray, along: np.ndarray) -> bool:
    """True where a line through `point` [m] lies on the z axis of a frame, in either sense."""
    z = axis.rotation[:, 2]
    away = point - axis.position
    apart, turned = np.linalg.norm(away - (away @ z) * z), np.linalg.norm(np.cross(z, along))
    return bool(apart < _ALIKE[0] and turned < _ALIKE[1])


def _axis(joint: ET.Element) -> np.ndarray:
    element = joint.find("axis")
    axis = np.array((element.get("xyz", "1 0 0") if element is not None else "1 0 0").split(), float)
    return axis / np.linalg.norm(axis)


def calibrated(model: str, description: ET.Element, file: Path) -> ET.Element:
    """The model's description with this arm's axes.

    Args:
        model: `ur5`, `ur10e`, …; another name is a description whose model is found by its axes.
        description: the model's, its base in DH frame 0.
        file: calibration.conf or the kinematics YAML.

    Raises:
        FileFormatError, CellValueError: not such a file, or not of this model.
    """
    model = model if model in MODELS else model_of(model, description, file)
    rows = nominal_rows(model, file)
    text = _text(file)
    if text.lstrip().startswith("{") or "kinematics:" in text:
        nominal, own = _yaml_axes(_nominal_steps(model)), _yaml_axes(_yaml_steps(text, file))
    else:
        nominal, own = _dh_axes(rows), _dh_axes(_with_deltas(rows, text, file))
    return _moved(description, nominal, own, file)


def _moved(root: ET.Element, nominal: list[Pose], own: list[Pose], file: Path) -> ET.Element:
    """The description with every moving joint on its new axis; the last of `own` is the flange."""
    root = copy.deepcopy(root)
    joints, moving = root.findall("joint"), _moving(root, file)
    last = _end(moving[-1], "child")
    behind = [joint for joint in joints if joint.get("type") == "fixed" and _end(joint, "parent") == last]
    old = new = Pose.identity()
    for number, joint in enumerate([*moving, *behind[:1]]):
        old = old @ origin_pose(joint)
        fixed, axis = nominal[number].inverse() @ old, own[number]
        if number < len(moving):
            along = axis.rotation[:, 2] @ (old.position - (axis @ fixed).position)
            axis = axis @ Pose.of(None, np.array([0.0, 0.0, along]))
        placed = axis @ fixed
        off = float(np.linalg.norm(placed.position - old.position))
        if off > _FARTHEST:
            raise FileFormatError(
                f"joint {number + 1} lies {off:.2f} m from the model's",
                file=file,
                expected="the calibration of this model of arm",
            )
        origin = joint.find("origin")
        if origin is not None:
            joint.remove(origin)
        joint.insert(2, origin_element(new.inverse() @ placed))
        new = placed
    return root


def _moving(root: ET.Element, file: Path) -> list[ET.Element]:
    """The six joints that move, in their order; raises FileFormatError."""
    moving = [joint for joint in root.findall("joint") if joint.get("type") != "fixed"]
    if len(moving) != 6:
        raise FileFormatError(
            f"the description has {len(moving)} joints", file=file, expected="6, as a UR has"
        )
    return moving


def _end(joint: ET.Element, which: str) -> str:
    element = joint.find(which)
    return "" if element is None else element.get("link", "")


def _dh_axes(rows: list[DhRow]) -> list[Pose]:
    """T_base_axis of every joint at zero, z its axis, and last of the flange."""
    place, axes = Pose.identity(), []
    for row in rows:
        place = place @ Pose.of(rot_z(row.theta), np.zeros(3))
        axes.append(place)
        place = place @ Pose.of(rot_x(row.alpha), np.array([row.a, 0.0, row.d]))
    return [*axes, place]


def _yaml_axes(steps: list[Pose]) -> list[Pose]:
    """The same from where each joint stands on the one before; the flange is the last link's frame."""
    axes = [steps[0]]
    for step in steps[1:]:
        axes.append(axes[-1] @ step)
    return [*axes, axes[-1]]


def _nominal_steps(model: str) -> list[Pose]:
    d1, a2, a3, d4, d5, d6 = MODELS[model]
    numbers = (
        (0, 0, d1, 0, 0, 0),
        (0, 0, 0, _RIGHT, 0, 0),
        (a2, 0, 0, 0, 0, 0),
        (a3, 0, d4, 0, 0, 0),
        (0, -d5, 0, _RIGHT, 0, 0),
        (0, d6, 0, _RIGHT, math.pi, math.pi),
    )
    return [pose_of(np.array(row[:3], float), np.array(row[3:], float)) for row in numbers]


def _yaml_steps(text: str, file: Path) -> list[Pose]:
    try:
        if "&" in text or "*" in text:
            raise ValueError
        links = yaml.safe_load(text)["kinematics"]
        rows = [
            [float(links[name][key]) for key in ("x", "y", "z", "roll", "pitch", "yaw")] for name in _LINKS
        ]
    except (yaml.YAMLError, ValueError, KeyError, TypeError, RecursionError):
        raise FileFormatError(
            "not six links with x, y, z, roll, pitch, yaw",
            file=file,
            expected=f"kinematics: {', '.join(_LINKS)}",
        ) from None
    if not np.isfinite(rows).all() or np.abs(rows).max() > 1e5:
        raise FileFormatError("a number that cannot be", file=file, expected="metres and radians")
    return [pose_of(np.array(row[:3]), np.array(row[3:])) for row in rows]


def _with_deltas(rows: list[DhRow], text: str, file: Path) -> list[DhRow]:
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    try:
        parser.read_string(text)
        section = next(s for s in parser.sections() if all(parser.has_option(s, key) for key in _DELTAS))
    except (configparser.Error, StopIteration):
        raise FileFormatError(
            "no section with " + ", ".join(_DELTAS),
            file=file,
            expected="a calibration.conf of Universal Robots",
        ) from None
    deltas = {}
    for key in _DELTAS:
        try:
            values = np.array(json.loads(parser.get(section, key)), float)
        except (ValueError, TypeError, RecursionError):
            values = np.zeros(0)
        if values.shape != (6,) or not np.isfinite(values).all() or np.abs(values).max() > 1e5:
            raise CellValueError(
                f"found {parser.get(section, key)[:40]!r}", file=file, column=key, expected="[six numbers]"
            )
        deltas[key] = values
    return [
        DhRow(row.a + a, row.alpha + alpha, row.d + d, row.theta + theta)
        for row, a, alpha, d, theta in zip(rows, *(deltas[k] for k in _DELTAS), strict=True)
    ]


def _text(file: Path) -> str:
    if not file.is_file():
        raise FileFormatError(
            "there is no such file", file=file, expected="a calibration of Universal Robots"
        )
    if file.stat().st_size > _LARGEST:
        raise FileFormatError("too large for a calibration", file=file, expected="calibration.conf or YAML")
    try:
        return file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise FileFormatError("not UTF-8 text", file=file, expected="calibration.conf or YAML") from None
