"""A description as one light zip: what is kept of an arm that somebody brought, and read again without surprises.

Macros are expanded, a calibration is in it, meshes are few triangles in one format, and every name leads into the zip.
"""

from __future__ import annotations

import copy
import io
import re
import xml.etree.ElementTree as ET
import zipfile

import numpy as np

from app.kinematics.meshes import Mesh, MeshFolder
from app.kinematics.robot import RobotModel

_NAME = 40  # characters of the description's own name
_OTHER = re.compile(r"[^\w-]+")
_MOMENT = (1980, 1, 1, 0, 0, 0)  # of every file in it: the same arm is the same zip


def packed(robot: RobotModel) -> bytes:
    """The description and the meshes that are drawn of it, in a zip; the same robot gives the same bytes.

    Args:
        robot: read from a person's own description; a mesh it lacks is left out.
    """
    root = ET.Element("robot", {"name": "arm"}) if robot.source is None else copy.deepcopy(robot.source)
    folder = MeshFolder(robot.path)
    files: dict[str, bytes] = {}
    for link in root.findall("link"):
        drawn = link.findall("visual")
        for part in link.findall("collision") if drawn else ():  # never looked at beside what is drawn
            link.remove(part)
        for part in drawn or link.findall("collision"):
            element = part.find("geometry/mesh")
            if element is None:
                continue
            scale = np.array(element.get("scale", "1 1 1").split(), float)
            mesh = folder.load(element.get("filename", ""), link.get("name", ""), scale)
            if mesh is None:
                link.remove(part)
                continue
            name = f"meshes/{len(files)}.ply"
            files[name] = _ply(mesh)
            element.attrib.clear()
            element.set("filename", name)
            if part.find("material") is None and mesh.colour is not None:
                material = ET.SubElement(part, "material", {"name": ""})
                ET.SubElement(material, "color", {"rgba": " ".join(f"{v:.4f}" for v in (*mesh.colour, 1.0))})
    text = ET.tostring(root, encoding="utf-8")
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as kept:
        for name, content in {f"{plain_name(robot.name)}.urdf": text, **files}.items():
            kept.writestr(zipfile.ZipInfo(name, _MOMENT), content, zipfile.ZIP_DEFLATED)
    return out.getvalue()


def plain_name(name: str) -> str:
    """A name that is one word for every file system."""
    return _OTHER.sub("_", name).strip("_")[:_NAME] or "arm"


def _ply(mesh: Mesh) -> bytes:
    """Binary PLY."""
    corners, triangles = mesh.vertices.astype("<f4"), mesh.triangles
    faces = np.empty(len(triangles), [("count", "u1"), ("corners", "<i4", (3,))])
    faces["count"], faces["corners"] = 3, triangles
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(corners)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    return head.encode("ascii") + corners.tobytes() + faces.tobytes()
