"""A dropped description becomes an arm, in a process of its own: no compiled library of the server sees it before."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

from app.errors import InputError
from app.kinematics import load_robot
from app.kinematics.description.address import parse_address
from app.kinematics.packing import packed, plain_name
from app.kinematics.solids import missing_meshes
from app.panel import Upload
from app.session.arms import Packed, unpacked_arm
from app.session.motion.guarding import guard_of, hit
from app.simulation.world import default_world


def bring(files: Sequence[Upload], folder: Path, part: str, most: int) -> Packed:
    """The arm that was dropped, tried out as the pendant will use it.

    Args:
        files: a description, a zip, or the files of a folder.
        folder: empty; they are moved into it.
        part: which part of it is the arm: BASE..TIP, a link as the flange, or "" for what the rules find.
        most: bytes that may be kept of it.

    Raises:
        FileFormatError, UnknownNameError: it is no arm's description, or several; says what there is.
        InputError: too much of it is drawn.
    """
    moved = [file.into(folder, "arm.urdf") for file in files]
    address = parse_address(str(moved[0] if len(moved) == 1 else folder))
    chosen = address.but(chain=part) if ".." in part else address.but(flange=part or None)
    robot = load_robot(str(chosen))
    content = packed(robot)
    if len(content) > most:
        raise InputError(
            f"the robot takes {len(content) / 1e6:.1f} MB with its meshes",
            expected=f"at most {most / 1e6:.0f} MB",
        )
    arm = Packed(plain_name(robot.name), f"{robot.base}..{robot.flange}", content, missing_meshes(robot))
    with tempfile.TemporaryDirectory(dir=folder) as again:
        kept = load_robot(unpacked_arm(arm, Path(again)))
        world = default_world(kept)
        guard_of(world)
        hit(world, kept.home)
    return arm
