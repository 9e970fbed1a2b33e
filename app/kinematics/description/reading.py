"""A robot's file, whatever its kind, as one checked tree of links and joints."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

from app.errors import FileFormatError
from app.kinematics.description.checked import check_description
from app.kinematics.description.dhtable import is_dh_table, read_dh_table
from app.kinematics.description.urcalibration import calibrated
from app.kinematics.description.xacro import expanded, is_xacro
from app.kinematics.description.xml import LARGEST, only_arm_parts, parse_xml


def read_description(path: Path, *, model: str = "", calibration: Path | None = None) -> ET.Element:
    """<robot> of a URDF, a xacro or a DH table, checked; with the maker's calibration in it where one is given.

    Args:
        path: the file.
        model: the arm's name in the maker's table, for a calibration.
        calibration: the maker's calibration file.

    Raises:
        FileFormatError, InputError: not a robot description; names what and where.
    """
    if not path.is_file():
        raise FileFormatError("is no ordinary file", file=path, expected="a robot description")
    if is_dh_table(path):
        root = read_dh_table(path)
    else:
        if path.stat().st_size > LARGEST:
            raise FileFormatError("too large for a robot description", file=path, expected="a URDF file")
        data = path.read_bytes()
        if is_xacro(path, data):
            data = expanded(path)
        root = parse_xml(data, path)
    check_description(root, path)
    if calibration is not None:
        root = calibrated(model or path.stem, root, calibration)
    return only_arm_parts(root)
