"""Solids a description draws its links with: boxes, cylinders, spheres and what is made of them.

Read from `<visual>` (from `<collision>` where a link has no other). Two attributes of our own refine a drawing;
other readers pass over them and still see the plain primitive:

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
from app.kinematics.description.placing import origin_pose
from app.kinematics.description.reading import read_description
from app.kinematics.meshes import Mesh, MeshFolder

GREY = (0.55, 0.57, 0.60)
KINDS = ("box", "cylinder", "sphere")
_SMALLEST = 1e-5  # m: a solid thinner than this has no hull and nobody sees it


@dataclass(frozen=True, eq=False)
class Shape:
    """One primitive, fixed to a body.

    Args:
        body: 0 the base, k what joint k moves.
        link: name of the link it belongs to, for messages.
        kind: "box" (size: edges x, y, z), "cylinder" (radius, length, radius at +Z), "sphere" (radius) [m],
            "halfspace" (no size: everything below its own XY plane; only for collision), "mesh" (no size).
        size: as the kind says.
        T_body_shape: where it sits.
        colour: red, green, blue, each 0..1.
        hull: shapes of one body with the same text are joined by their convex hull; "" stands alone.
        collides: False for what is only drawn.
        mesh: what is drawn of a "mesh"; what can be hit is its convex hull.
    """

    body: int
    link: str
    kind: str
    size: tuple[float, ...]
    T_body_shape: Pose
    colour: tuple[float, float, float] = GREY
    hull: str = ""
    collides: bool = True
    mesh: Mesh | None = None

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
    """Primitives of every link of a URDF, on the moving bodies they belong to; meshes are passed over.

    Args:
        path: the URDF.
        joint_names: the arm's joints in order; body k is what the k-th moves.
    """
    return shapes_of(read_description(path), joint_names, path)


def shapes_of(
    root: ET.Element,
    joint_names: tuple[str, ...],
    path: Path,
    *,
    base: str | None = None,
    meshes: MeshFolder | None = None,
) -> tuple[Shape, ...]:
    """What a checked description draws, on the moving bodies it belongs to.

    Links beyond joints that are not in `joint_names` (grippers) are drawn with those joints at zero.

    Args:
        root: the description.
        joint_names: the arm's joints in order; body k is what the k-th moves.
        path: the file, for messages.
        base: the link body 0 is in; None the root. What does not hang on it is left out.
        meshes: where meshes are; None passes them over.
    """
    colours = {m.get("name", ""): _rgb(m) for m in root.findall("material")}
    bodies = {name: k for k, name in enumerate(joint_names, 1)}
    parent: dict[str, tuple[str, Pose, int]] = {}
    for joint in root.findall("joint"):
        child, mother = joint.find("child"), joint.find("parent")
        if child is not None and mother is not None:
            body = bodies.get(joint.get("name", ""), 0)
            parent[child.get("link", "")] = (mother.get("link", ""), origin_pose(joint), body)

    def place(link: str) -> tuple[int, Pose] | None:
        """The moving body a link is fixed to, and where on it; None where it does not hang on the base."""
        pose = Pose.identity()
        for _ in range(len(parent) + 1):
            if link == base or link not in parent:
                return (0, pose) if base is None or link == base else None
            mother, step, body = parent[link]
            if body:  # its frame is where the joint has moved it
                return body, pose
            pose, link = step @ pose, mother
        return None

    shapes = []
    for link in root.findall("link"):
        name = link.get("name", "")
        visuals = link.findall("visual") or link.findall("collision")
        found = place(name) if visuals else None
        if found is None:
            continue
        for visual in visuals:
            shape = _shape(visual, name, colours, path, meshes)
            if shape is not None:
                shapes.append(shape.moved(*found))
    return tuple(shapes)


def _shape(
    visual: ET.Element, link: str, colours: dict, path: Path, meshes: MeshFolder | None
) -> Shape | None:
    geometry = visual.find("geometry")
    inner = () if geometry is None else geometry
    drawn = next((e for e in inner if e.tag == "mesh"), None)
    if drawn is not None and meshes is not None:
        return _mesh_shape(visual, drawn, link, colours, meshes)
    element = next((e for e in inner if e.tag in KINDS), None)
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
    if min(size[:2] if element.tag == "cylinder" else size) < _SMALLEST:
        return None
    return Shape(
        0,
        link,
        element.tag,
        size,
        origin_pose(visual),
        _colour(visual, colours) or GREY,
        visual.get("hull", ""),
        visual.get("collide", "yes") != "no",
    )


def _mesh_shape(
    visual: ET.Element, element: ET.Element, link: str, colours: dict, meshes: MeshFolder
) -> Shape | None:
    scale = np.array(element.get("scale", "1 1 1").split(), float)
    mesh = meshes.load(element.get("filename", ""), link, scale)
    if mesh is None:
        return None
    colour = _colour(visual, colours) or mesh.colour or GREY
    return Shape(0, link, "mesh", (), origin_pose(visual), colour, mesh=mesh)


def _colour(visual: ET.Element, colours: dict) -> tuple[float, float, float] | None:
    material = visual.find("material")
    return None if material is None else _rgb(material) or colours.get(material.get("name", ""))


def _rgb(material: ET.Element) -> tuple[float, float, float] | None:
    colour = material.find("color")
    if colour is None:
        return None
    red, green, blue = (min(max(float(v), 0.0), 1.0) for v in colour.get("rgba", "0.5 0.5 0.5 1").split()[:3])
    return red, green, blue


def _z_along(direction: np.ndarray) -> np.ndarray:
    """Any rotation whose third column is `direction` (unit)."""
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    x = np.cross(helper, direction)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(direction, x), direction], axis=1)
