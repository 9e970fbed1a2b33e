"""URDF as plain elements, read so that no file can do harm: bounded, without entities, names as they are written.

Prefixes are not resolved: `<gazebo:plugin>` is an element of that very name, whether or not somebody declared
`gazebo`, and is dropped with all that is not part of the arm.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path
from xml.parsers import expat

from app.errors import FileFormatError

LARGEST = 20_000_000  # bytes: the largest public descriptions, of whole humanoids, have under 2 MB
_DEEPEST = 60  # elements within elements; URDF needs 5
_MOST = 200_000  # elements: links, joints and their parts
#: Below <robot>: all that an arm is made of; the rest (gazebo, transmission, ros2_control) is for others.
_KEPT = frozenset({"link", "joint", "material"})


def parse_xml(data: bytes, path: Path) -> ET.Element:
    """The outermost element.

    Raises:
        FileFormatError: not XML, entities of its own, too large or nested too deeply; names the line.
    """
    if len(data) > LARGEST:
        raise FileFormatError("too large for a robot description", file=path, expected="a URDF file")
    parser = expat.ParserCreate()
    builder = ET.TreeBuilder()
    depth = count = 0

    def line() -> int:
        return parser.CurrentLineNumber

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth, count
        depth, count = depth + 1, count + 1
        if depth > _DEEPEST or count > _MOST:
            what = f"over {_DEEPEST} elements deep" if depth > _DEEPEST else f"over {_MOST} elements"
            raise FileFormatError(what, file=path, row=line(), expected="a URDF file")
        builder.start(tag, attributes)

    def end(tag: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(tag)

    def entity(name: str, *_: object) -> None:
        raise FileFormatError(
            f"declares an entity {name[:40]!r}",
            file=path,
            row=line(),
            expected="a URDF file without entities",
        )

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler, parser.EntityDeclHandler = builder.data, entity
    try:
        parser.Parse(data, True)
        root = builder.close()
    except (expat.ExpatError, LookupError, ValueError, AssertionError, TypeError) as error:
        raise FileFormatError(f"not XML ({error})", file=path, expected="a URDF file") from None
    return root


def only_arm_parts(root: ET.Element) -> ET.Element:
    """The description without what is addressed to simulators and controllers."""
    kept = ET.Element("robot", dict(root.attrib))
    kept.extend(element for element in root if element.tag in _KEPT)
    return kept
