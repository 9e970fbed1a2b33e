"""Finds a robot by name or path and reads its URDF."""

from __future__ import annotations

import tomllib
import xml.etree.ElementTree as ET
from pathlib import Path

import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)

from app import catalog, resources
from app.errors import FileFormatError, InputError, UnknownNameError
from app.kinematics.robot import Joint, RobotModel

#: Names of the frame where tools are bolted on, best first; else the last link of the chain.
FLANGE_NAMES = ("tool0", "flange", "ee_link")
_LARGEST_URDF = 20_000_000  # bytes


def robot_names() -> list[str]:
    """Names of the shipped robots: the folders under robots/."""
    return sorted(catalog.folders(resources.ROBOTS, "robot.toml"))


def load_robot(name_or_path: str | Path, *, relative_to: Path | None = None) -> RobotModel:
    """A shipped robot by name, or any URDF by path.

    Args:
        name_or_path: a folder name under robots/, or the path of a .urdf file.
        relative_to: folder against which a relative path is tried first.

    Raises:
        UnknownNameError: neither a shipped robot nor a file.
        FileFormatError: the file is not a URDF with 1 to 8 moving joints.
    """
    text = str(name_or_path)
    shipped = catalog.folders(resources.ROBOTS, "robot.toml")
    if text in shipped:
        folder = shipped[text]
        with (folder / "robot.toml").open("rb") as file:
            return _from_urdf(folder / "robot.urdf", name=text, description=tomllib.load(file))
    candidates = [Path(text)] if relative_to is None else [relative_to / text, Path(text)]
    for path in candidates:
        if path.is_file():
            return _from_urdf(path, name=path.stem, description={})
    raise UnknownNameError(text, available=shipped, what="robot (and no such file)")


def _read_tree(path: Path) -> ET.Element:
    if path.stat().st_size > _LARGEST_URDF:
        raise FileFormatError("too large for a robot description", file=path, expected="a URDF file")
    try:
        root = ET.parse(path).getroot()
    except (ET.ParseError, UnicodeDecodeError, ValueError) as error:
        raise FileFormatError(f"not XML ({error})", file=path, expected="a URDF file") from None
    if root.tag != "robot":
        raise FileFormatError(f"the outermost element is <{root.tag}>", file=path, expected="<robot>")
    return root


def _main_chain(root: ET.Element, path: Path) -> list[ET.Element]:
    """Joints from the base to the flange, in order."""
    parents: dict[str, ET.Element] = {}
    links = [link.get("name", "") for link in root.findall("link")]
    for joint in root.findall("joint"):
        parent, child = joint.find("parent"), joint.find("child")
        if parent is None or child is None:
            raise FileFormatError(
                f"joint {joint.get('name')!r} lacks its parent or child", file=path, expected="both"
            )
        parents[child.get("link", "")] = joint

    def up(link: str) -> list[ET.Element]:
        joints: list[ET.Element] = []
        while link in parents:
            joint = parents[link]
            if joint in joints:
                raise FileFormatError("the joints form a loop", file=path, expected="a tree of links")
            joints.append(joint)
            link = joint.find("parent").get("link", "")  # type: ignore[union-attr]
        return joints[::-1]

    def moving(chain: list[ET.Element]) -> int:
        return sum(joint.get("type") != "fixed" for joint in chain)

    chains = {link: up(link) for link in links}
    if not chains:
        raise FileFormatError("no links", file=path, expected="a URDF file with links and joints")
    for name in FLANGE_NAMES:
        if moving(chains.get(name, [])):
            return chains[name]
    most = max(moving(chain) for chain in chains.values())
    longest = max((chain for chain in chains.values() if moving(chain) == most), key=len)
    for k, joint in enumerate(longest):  # where moving branches part behind the arm, a gripper begins
        fork = joint.find("parent").get("link", "")  # type: ignore[union-attr]
        before = longest[:k]
        branches = {
            chain[k].get("name")
            for chain in chains.values()
            if chain[:k] == before and len(chain) > k and moving(chain[k:])
        }
        if moving(before) and len(branches) > 1 and before[-1].find("child").get("link") == fork:  # type: ignore[union-attr]
            return before
    return longest


def _from_urdf(path: Path, *, name: str, description: dict) -> RobotModel:
    root = _read_tree(path)
    chain = _main_chain(root, path)
    moving = [joint for joint in chain if joint.get("type") != "fixed"]
    if not 1 <= len(moving) <= 8:
        raise FileFormatError(f"{len(moving)} moving joints", file=path, expected="1 to 8 in a row")
    for joint in moving:
        if joint.get("type") not in ("revolute", "continuous", "prismatic"):
            raise FileFormatError(
                f"joint {joint.get('name')!r} is of type {joint.get('type')!r}",
                file=path,
                expected="revolute, continuous or prismatic",
            )
        _give_limits(joint, path)
    for link in root.findall("link"):  # shapes do not matter here and their meshes may be absent
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
    try:
        model = pin.buildModelFromXML(ET.tostring(root, encoding="unicode"))
    except (ValueError, RuntimeError) as error:
        reason = str(error).splitlines()[0] if str(error) else "unreadable"
        raise FileFormatError(f"pin cannot build it: {reason}", file=path, expected="a URDF file") from None
    wanted = [joint.get("name", "") for joint in moving]
    others = [i for i, n in enumerate(model.names) if i > 0 and n not in wanted]
    if others:  # grippers and the like stay at zero
        model = pin.buildReducedModel(model, others, pin.neutral(model))
    joints = tuple(_joint(joint) for joint in moving)
    tip = chain[-1].find("child")
    assert tip is not None
    return RobotModel(name, path, joints, model, tip.get("link", ""), description)


def _give_limits(joint: ET.Element, path: Path) -> None:
    """A continuous joint becomes a revolute one of two turns either way, so that one number is its angle."""
    limit = joint.find("limit")
    if joint.get("type") == "continuous":
        joint.set("type", "revolute")
        if limit is None:
            limit = ET.SubElement(joint, "limit", {"effort": "0", "velocity": "0"})
        limit.set("lower", "-12.566370614359172")
        limit.set("upper", "12.566370614359172")
    if limit is None:
        raise FileFormatError(
            f"joint {joint.get('name')!r} has no limits", file=path, expected="<limit lower upper …>"
        )
    for key in ("lower", "upper", "velocity", "effort"):
        try:
            float(limit.get(key, "0"))
        except ValueError:
            raise InputError(
                f"limit {key} of joint {joint.get('name')!r} is {limit.get(key)!r}",
                file=path,
                expected="a number",
            ) from None


def _joint(element: ET.Element) -> Joint:
    name = element.get("name", "")
    limit = element.find("limit")
    assert limit is not None
    return Joint(
        name=name,
        prismatic=element.get("type") == "prismatic",
        lower=float(limit.get("lower", "0")),
        upper=float(limit.get("upper", "0")),
        velocity=float(limit.get("velocity", "0")),
        effort=float(limit.get("effort", "0")),
    )
