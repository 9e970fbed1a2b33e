"""Solids a description draws its links with: boxes, cylinders, spheres and what is made of them.

Read from `<visual>`. Two attributes of our own refine a drawing; other readers pass over them and still
see the plain primitive:

    <cylinder radius=".." length=".." top_radius=".."/>   a cone frustum, narrower (or wider) at +Z
    <visual hull="NAME">                                   solids of one link with the same NAME are joined
                                                           by their convex hull (an arm that tapers)
    <visual collide="no">                                  drawn, but nothing can hit it (hoses, labels)
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from app.errors import FileFormatError
from app.geometry.pose import Pose
from app.geometry.rotation import rot_x, rot_y, rot_z

GREY = (0.55, 0.57, 0.60)
KINDS = ("box", "cylinder", "sphere")


@dataclass(frozen=True, eq=False)
class Shape:
    """One primitive, fixed to a body.

    Args:
        body: 0 the base, k what joint k moves.
        link: name of the link it belongs to, for messages.
        kind: "box" (size: edges x, y, z), "cylinder" (radius, length, radius at +Z), "sphere" (radius) [m],
            "halfspace" (no size: everything below its own XY plane; only for collision).
        size: as the kind says.
        T_body_shape: where it sits.
        colour: red, green, blue, each 0..1.
        hull: shapes of one body with the same text are joined by their convex hull; "" stands alone.
        collides: False for what is only drawn.
    """

    body: int
    link: str
    kind: str
    size: tuple[float, ...]
    T_body_shape: Pose
    colour: tuple[float, float, float] = GREY
    hull: str = ""
    collides: bool = True

    def moved(self, body: int, T_body_old: Pose) -> Shape:
        """The same shape on another body."""
        return replace(self, body=body, T_body_shape=T_body_old @ self.T_body_shape)


def box(size, centre=(0.0, 0.0, 0.0), *, link: str = "box", **others) -> Shape:
    """A box of edges `size` [m] around `centre` [m], for obstacles and tools."""
    return Shape(0, link, "box", tuple(map(float, size)), Pose.of(None, np.asarray(centre, float)), **others)


def rod(start, end, radius: float, end_radius: float | None = None, *, link: str = "rod", **others) -> Shape:
    """A cylinder, or a frustum, between two points [m]; `end_radius` 0 makes a cone."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    along = end - start
    length = float(np.linalg.norm(along))
    top = radius if end_radius is None else end_radius
    pose = Pose.of(_z_along(along / length), (start + end) / 2)
    return Shape(0, link, "cylinder", (float(radius), length, float(top)), pose, **others)


def ball(centre, radius: float, *, link: str = "ball", **others) -> Shape:
    """A sphere."""
    return Shape(0, link, "sphere", (float(radius),), Pose.of(None, np.asarray(centre, float)), **others)


def floor(height: float = 0.0, *, link: str = "floor") -> Shape:
    """Everything below a height [m]: a floor or a table without edges."""
    return Shape(0, link, "halfspace", (), Pose.of(None, np.array([0.0, 0.0, height])))


def read_shapes(path: Path, joint_names: tuple[str, ...]) -> tuple[Shape, ...]:
    """Primitives of every link of a URDF, on the moving bodies they belong to.

    Links beyond joints that are not in `joint_names` (grippers) are drawn with those joints at zero.
    Meshes are passed over.

    Args:
        path: the URDF.
        joint_names: the arm's joints in order; body k is what the k-th moves.
    """
    root = ET.parse(path).getroot()
    colours = {m.get("name", ""): _rgb(m) for m in root.findall("material")}
    parent: dict[str, tuple[str, Pose, int]] = {}
    for joint in root.findall("joint"):
        child, mother = joint.find("child"), joint.find("parent")
        if child is None or mother is None:
            continue
        name = joint.get("name", "")
        body = joint_names.index(name) + 1 if name in joint_names else 0
        parent[child.get("link", "")] = (mother.get("link", ""), _origin(joint, path), body)

    def place(link: str) -> tuple[int, Pose]:
        """The moving body a link is fixed to, and where on it."""
        pose = Pose.identity()
        while link in parent:
            mother, step, body = parent[link]
            if body:  # its frame is where the joint has moved it
                return body, pose
            pose, link = step @ pose, mother
        return 0, pose

    shapes = []
    for link in root.findall("link"):
        name = link.get("name", "")
        visuals = link.findall("visual")
        body, T_body_link = place(name) if visuals else (0, Pose.identity())
        for visual in visuals:
            shape = _shape(visual, name, colours, path)
            if shape is not None:
                shapes.append(shape.moved(body, T_body_link))
    return tuple(shapes)


def _shape(visual: ET.Element, link: str, colours: dict, path: Path) -> Shape | None:
    geometry = visual.find("geometry")
    element = next((e for e in (geometry if geometry is not None else ()) if e.tag in KINDS), None)
    if element is None:
        return None
    try:
        if element.tag == "box":
            size = tuple(float(v) for v in element.get("size", "").split())
        elif element.tag == "cylinder":
            radius = float(element.get("radius", ""))
            size = (radius, float(element.get("length", "")), float(element.get("top_radius", radius)))
        else:
            size = (float(element.get("radius", "")),)
    except ValueError:
        size = ()
    if len(size) != {"box": 3, "cylinder": 3, "sphere": 1}[element.tag]:
        raise FileFormatError(
            f"a {element.tag} of link {link!r} lacks its size", file=path, expected="numbers"
        )
    material = visual.find("material")
    colour = GREY
    if material is not None:
        colour = _rgb(material) or colours.get(material.get("name", "")) or GREY
    return Shape(
        0,
        link,
        element.tag,
        size,
        _origin(visual, path),
        colour,
        visual.get("hull", ""),
        visual.get("collide", "yes") != "no",
    )


def _rgb(material: ET.Element) -> tuple[float, float, float] | None:
    colour = material.find("color")
    if colour is None:
        return None
    values = [float(v) for v in colour.get("rgba", "0.5 0.5 0.5 1").split()]
    return values[0], values[1], values[2]


def _origin(element: ET.Element, path: Path) -> Pose:
    origin = element.find("origin")
    if origin is None:
        return Pose.identity()
    try:
        x, y, z = (float(v) for v in origin.get("xyz", "0 0 0").split())
        roll, pitch, yaw = (float(v) for v in origin.get("rpy", "0 0 0").split())
    except ValueError:
        raise FileFormatError("an <origin> is not three numbers", file=path, expected="xyz and rpy") from None
    return Pose.of(rot_z(yaw) @ rot_y(pitch) @ rot_x(roll), np.array([x, y, z]))


def _z_along(direction: np.ndarray) -> np.ndarray:
    """Any rotation whose third column is `direction` (unit)."""
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    x = np.cross(helper, direction)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(direction, x), direction], axis=1)
