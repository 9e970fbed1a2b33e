"""Finds a robot by name or path and reads its description."""

from __future__ import annotations

import tomllib
import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)

from app import catalog, resources
from app.errors import FileFormatError, UnknownNameError
from app.kinematics.description.address import Address, parse_address
from app.kinematics.description.arm import Arm, find_arm
from app.kinematics.description.package import description_in
from app.kinematics.description.plain import plain_urdf
from app.kinematics.description.reading import read_description
from app.kinematics.description.tree import JointElement, tree_of
from app.kinematics.description.urcalibration import MODELS, bare_arm, calibrated
from app.kinematics.robot import Follower, Joint, RobotModel


def robot_names() -> list[str]:
    """Names of the shipped robots: the folders under robots/."""
    return list(_names(resources.ROBOTS, resources.ROBOTS.stat().st_mtime_ns))


@lru_cache(maxsize=4)
def _names(root: Path, _changed: int) -> tuple[str, ...]:
    """Read again where the folder has changed: whoever opens a session asks seven times."""
    return tuple(sorted(catalog.folders(root, "robot.toml")))


def load_robot(name_or_path: str | Path, *, relative_to: Path | None = None) -> RobotModel:
    """A shipped robot by name, one by its maker's table of axes, or any description by path.

    Args:
        name_or_path: a folder name under robots/, a name of `makers_tables`, or the path of a URDF, a xacro
            file, a DH table, or a folder or zip with one of them; behind it
            `#flange=LINK`, `#chain=BASE..TIP`, `#calibration=FILE` where one is chosen.
        relative_to: folder against which a relative path is tried first.

    Raises:
        UnknownNameError: neither a shipped robot nor a file, or a link that is not in it.
        FileFormatError: the file is not the description of an arm, or of several.
    """
    address = parse_address(str(name_or_path))
    shipped = catalog.folders(resources.ROBOTS, "robot.toml")
    calibration = None
    if address.calibration is not None:
        calibration = found_beside(address.calibration, relative_to) or Path(address.calibration)
    if address.place in shipped:
        folder = shipped[address.place]
        with (folder / "robot.toml").open("rb") as file:
            description = tomllib.load(file)
        return _from_file(folder / "robot.urdf", address, address.place, description, calibration)
    path = found_beside(address.place, relative_to)
    if path is None and address.place in MODELS:
        bare = bare_arm(address.place)
        root = bare if calibration is None else calibrated(address.place, bare, calibration)
        return _built(root, Path(address.place), address, address.place, {})
    if path is None:
        raise UnknownNameError(
            address.place, available=[*shipped, *makers_tables()], what="robot (and no such file)"
        )
    path = description_in(path)
    return _from_file(path, address, path.name.partition(".")[0] or path.name, {}, calibration)


def makers_tables() -> list[str]:
    """Names that are known by their maker's table of axes alone: no masses, no shapes."""
    return sorted(set(MODELS) - set(robot_names()))


def found_beside(name: str, folder: Path | None) -> Path | None:
    """The file or folder of that name, relative to `folder` first; None where there is none."""
    for path in [Path(name)] if folder is None else [folder / name, Path(name)]:
        try:
            if name and path.exists():
                return path
        except (OSError, ValueError):  # a name too long, or with a zero byte in it
            return None
    return None


def _from_file(
    path: Path, address: Address, name: str, description: dict, calibration: Path | None
) -> RobotModel:
    root = read_description(path, model=name, calibration=calibration)
    return _built(root, path, address, name, description)


def _built(root: ET.Element, path: Path, address: Address, name: str, description: dict) -> RobotModel:
    tree = tree_of(root, path)
    arm = find_arm(tree, address)
    plain = plain_urdf(tree, arm)
    text = ET.tostring(plain, encoding="unicode")
    try:
        model = pin.buildModelFromXML(text, mimic=bool(arm.following))
    except (ValueError, RuntimeError) as error:
        reason = str(error).splitlines()[0] if str(error) else "unreadable"
        raise FileFormatError(f"pin cannot build it: {reason}", file=path, expected="a URDF file") from None
    where = replace(address, place=address.place if description else str(path))
    return RobotModel(
        name,
        path,
        tuple(_joint(joint) for joint in plain.findall("joint") if _counts(joint)),
        model,
        arm.flange,
        description,
        base=arm.base,
        address=str(where),
        urdf=text,
        followers=tuple(_follower(joint, arm, path) for joint in arm.following),
        source=root,
    )


def _counts(joint: ET.Element) -> bool:
    return joint.get("type") != "fixed" and joint.find("mimic") is None


def _joint(element: ET.Element) -> Joint:
    limit = element.find("limit")
    assert limit is not None  # plain.py gives every moving joint one
    return Joint(
        name=element.get("name", ""),
        prismatic=element.get("type") == "prismatic",
        lower=float(limit.get("lower", "0")),
        upper=float(limit.get("upper", "0")),
        velocity=float(limit.get("velocity", "0")),
        effort=float(limit.get("effort", "0")),
    )


def _follower(joint: JointElement, arm: Arm, path: Path) -> Follower:
    mimic = joint.element.find("mimic")
    assert mimic is not None
    names = [j.name for j in arm.moving]
    if joint.mimics not in names:
        raise FileFormatError(
            f"joint {joint.name!r} follows {joint.mimics!r}, which follows another",
            file=path,
            expected="a joint that moves on its own",
        )
    return Follower(
        name=joint.name,
        prismatic=joint.kind == "prismatic",
        master=names.index(str(joint.mimics)),
        multiplier=float(mimic.get("multiplier", "1")),
        offset=float(mimic.get("offset", "0")),
    )
