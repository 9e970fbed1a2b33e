"""The robot that a file names: a shipped one, or a description that lies with the file.

What a person types on a command line is opened wherever it lies. What a file says is data that somebody else may have
written: it reaches the file's own folder, what is below it and the folder above (recordings beside descriptions), and
only what is called a description. Whether anything lies elsewhere is not told.
"""

from __future__ import annotations

from pathlib import Path

from app.errors import UnknownNameError
from app.kinematics.description.address import parse_address
from app.kinematics.loading import load_robot, makers_tables, robot_names
from app.kinematics.robot import RobotModel

#: What a description's file is called.
ENDINGS = (".urdf", ".xacro", ".xml", ".zip", ".csv")
#: What a maker's calibration of one arm is called.
CALIBRATIONS = (".conf", ".yaml", ".yml")


def robot_of_file(stated: str, file: str | Path) -> RobotModel:
    """The robot that the file at `file` names.

    Args:
        stated: a shipped name, or a path relative to the file; choices of flange and chain may stand behind a `#`.

    Raises:
        UnknownNameError: neither of these, or outside the folders that belong to the file.
        InputError: it cannot be loaded.
    """
    address = parse_address(stated)
    names = (*robot_names(), *makers_tables())
    known = address.place in names or _within(address.place, Path(file).parent, ENDINGS)
    if not known or not (
        address.calibration is None or _within(address.calibration, Path(file).parent, CALIBRATIONS)
    ):
        raise UnknownNameError(
            stated[:80],
            available=names,
            what="robot (and no such file beside this one)",
            file=file,
            column="# robot",
        )
    return load_robot(stated, relative_to=Path(file).parent)


def _within(place: str, folder: Path, endings: tuple[str, ...]) -> bool:
    """True for a file of such a name that lies below the folder above `folder`."""
    try:
        path = (folder / place).resolve()
        return (
            path.name.lower().endswith(endings)
            and path.is_file()
            and path.is_relative_to(folder.resolve().parent)
        )
    except (OSError, ValueError, RuntimeError):  # a name too long, a zero byte, links in a ring
        return False
