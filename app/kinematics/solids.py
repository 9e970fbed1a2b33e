"""Convex solids of an arm: what is drawn, and what can be hit.

Every primitive is convex, and so is the hull that joins several; so one convex hull of points serves the
picture and the collision check alike.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.kinematics.meshes import Mesh, MeshFolder
from app.kinematics.robot import RobotModel
from app.kinematics.shapes import Shape, ball, read_shapes, rod, shapes_of

_CHAMFER = 0.12  # of a solid's smallest extent
_LARGEST_CHAMFER = 0.012  # m
_SMALL = 0.03  # m: rods thinner than this keep their edges, nobody sees them


@dataclass(frozen=True, eq=False)
class Solid:
    """One convex solid, fixed to a body.

    Args:
        body: 0 the base, k what joint k moves.
        link: the link's name, for messages.
        points: (k, 3) [m] in the body's frame; the solid is their convex hull.
        colour: red, green, blue, each 0..1.
        collides: False for what is only drawn.
        mesh: triangles to draw in place of the hull, in the body's frame; None where the hull is what is drawn.
    """

    body: int
    link: str
    points: np.ndarray
    colour: tuple[float, float, float]
    collides: bool
    mesh: Mesh | None = None


def robot_solids(robot: RobotModel) -> tuple[Solid, ...]:
    """Solids of a robot's links, see `robot_shapes`."""
    return solids(robot_shapes(robot))


def robot_shapes(robot: RobotModel) -> tuple[Shape, ...]:
    """Shapes of a robot's links: as its description draws them, else a stick figure of its joints.

    A description whose meshes are elsewhere draws too little of itself: less than half of its bodies.
    """
    return _drawn(robot)[0]


def missing_meshes(robot: RobotModel) -> tuple[str, ...]:
    """One line for every mesh that the description names and that is not drawn, with the reason."""
    return _drawn(robot)[1]


def _drawn(robot: RobotModel) -> tuple[tuple[Shape, ...], tuple[str, ...]]:
    """Shapes and missing meshes; read once a robot, since meshes are large."""
    if robot.source is None:
        return stick_figure(robot), ()
    if "shapes" not in robot.kept:
        folder = MeshFolder(robot.path)
        names = tuple(j.name for j in (*robot.joints, *robot.followers))
        shapes = shapes_of(robot.source, names, robot.path, base=robot.base, meshes=folder)
        drawn = {shape.body for shape in shapes} - {0}
        if 2 * len(drawn) < robot.joint_count:
            shapes = stick_figure(robot)
        robot.kept["shapes"] = shapes, folder.missing
    return robot.kept["shapes"]


def tool_shapes(robot: RobotModel) -> tuple[Shape, ...]:
    """Shapes of the tool a shipped robot carries (`tool.urdf` beside its description), in the flange's frame."""
    path = robot.path.with_name("tool.urdf")
    return read_shapes(path, ()) if robot.description and path.is_file() else ()


def solids(shapes: Sequence[Shape]) -> tuple[Solid, ...]:
    """Joins the shapes that share a hull; the others stand alone."""
    families: dict[object, list[Shape]] = {}
    for index, shape in enumerate(shapes):
        key = (shape.body, shape.link, shape.hull) if shape.hull else index
        families.setdefault(key, []).append(shape)
    return tuple(
        Solid(
            family[0].body,
            family[0].link,
            np.concatenate([shape.T_body_shape.apply(outline(shape)) for shape in family]),
            family[0].colour,
            family[0].collides,
            family[0].mesh.placed(family[0].T_body_shape) if family[0].mesh is not None else None,
        )
        for family in families.values()
    )


def outline(shape: Shape, chamfer: float = _CHAMFER) -> np.ndarray:
    """Points whose convex hull is the shape; (k, 3) [m] in the shape's frame.

    Args:
        chamfer: how much of its smallest extent an edge loses, to look cast rather than cut; 0 is sharp.
    """
    if shape.mesh is not None:
        return shape.mesh.hull
    if shape.kind == "sphere":
        return _sphere_points(shape.size[0])
    if shape.kind == "box":
        half = np.array(shape.size) / 2
        cut = min(chamfer * 2 * half.min(), _LARGEST_CHAMFER)
        signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
        if cut == 0:
            return signs * half
        return np.concatenate([signs * (half - cut * (np.arange(3) != axis)) for axis in range(3)])
    bottom, length, top = shape.size
    rings = []
    if max(bottom, top) < _SMALL:
        chamfer = 0.0
    for radius, z, inwards in ((bottom, -length / 2, 1.0), (top, length / 2, -1.0)):
        cut = min(chamfer * min(2 * radius, length), _LARGEST_CHAMFER)
        if cut > 0:
            rings.append(_ring(max(radius - cut, 1e-4), z))
        rings.append(_ring(max(radius, 1e-4), z + inwards * cut))
    return np.concatenate(rings)


def faces(points: np.ndarray, crease: float = 0.6) -> tuple[np.ndarray, np.ndarray]:
    """Triangles of a convex hull, its vertices parted along edges sharper than `crease` [rad].

    A viewer that averages the normals of shared vertices then shows rounds round and edges sharp.

    Returns:
        vertices (k, 3), triangles (t, 3), wound outwards; neither may be written to, because the same solid drawn
        again, in another session, is not worked out again.
    """
    points = np.ascontiguousarray(points, float)
    return _faces(points.tobytes(), crease)


@lru_cache(maxsize=1024)
def _faces(packed: bytes, crease: float) -> tuple[np.ndarray, np.ndarray]:
    points = np.frombuffer(packed).reshape(-1, 3)
    from scipy.spatial import ConvexHull  # slow to load; a session has many parts that draw nothing

    hull = ConvexHull(points)
    triangles, normals = hull.simplices.copy(), hull.equations[:, :3]
    corner = points[triangles]
    winding = np.einsum(
        "ij,ij->i", np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), normals
    )
    triangles[winding < 0] = triangles[winding < 0][:, ::-1]
    smooth = np.arange(len(triangles))  # union-find over neighbours that meet softly
    for a, neighbours in enumerate(hull.neighbors):
        for b in neighbours:
            if a < b and normals[a] @ normals[b] > np.cos(crease):
                ra, rb = _root(smooth, a), _root(smooth, b)
                smooth[rb] = ra
    group = np.array([_root(smooth, i) for i in range(len(triangles))])
    keys = np.stack([triangles.ravel(), np.repeat(group, 3)], axis=1)
    unique, inverse = np.unique(keys, axis=0, return_inverse=True)
    vertices, triangles = points[unique[:, 0]], inverse.reshape(-1, 3)
    for drawn in (vertices, triangles):
        drawn.setflags(write=False)
    return vertices, triangles


def stick_figure(robot: RobotModel) -> tuple[Shape, ...]:
    """A drawing for a description without shapes: a can at every joint, rods between them."""
    chain = robot.chain
    scale = max(robot.reach, 0.1)
    thick, dark = 0.035 * scale, (0.25, 0.27, 0.30)
    steps = chain.steps
    foot = steps[0].rotation @ steps[0].axis * thick
    shapes = [rod(np.zeros(3), foot, 2.4 * thick, 2.0 * thick, link="base", colour=dark)]
    body = 0
    for step in steps:
        shapes += _rod_along(body, step.translation, thick)
        body = step.body
        axis = step.axis * 1.6 * thick
        shapes.append(_on(body, rod(-axis, axis, 1.3 * thick, link=f"joint {body}", colour=dark)))
    shapes += _rod_along(body, chain.flange_translation, thick)
    shapes.append(_on(body, ball(chain.flange_translation, thick, link="flange")))
    return tuple(shapes)


def _rod_along(body: int, span: np.ndarray, thick: float) -> list[Shape]:
    """A rod from a body's origin along (3,) [m], where that is long enough to be seen."""
    if np.linalg.norm(span) <= thick:
        return []
    link = f"link {body}" if body else "base"
    return [_on(body, rod(np.zeros(3), span, thick, 0.8 * thick, link=link))]


def _on(body: int, shape: Shape) -> Shape:
    return Shape(body, shape.link, shape.kind, shape.size, shape.T_body_shape, shape.colour)


def _ring(radius: float, z: float) -> np.ndarray:
    count = 8 if radius < 0.015 else 12 if radius < 0.03 else 18 if radius < 0.08 else 24
    angle = np.arange(count) * (2 * np.pi / count)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(count, z)], axis=1)


def _sphere_points(radius: float) -> np.ndarray:
    rings = 3 if radius < 0.03 else 7 if radius < 0.08 else 11
    polar = np.linspace(0, np.pi, rings + 2)[1:-1]
    around = [_ring(radius * np.sin(p), radius * np.cos(p)) for p in polar]
    return np.concatenate([*around, [[0, 0, radius], [0, 0, -radius]]])


def _root(parents: np.ndarray, i: int) -> int:
    while parents[i] != i:
        parents[i] = parents[parents[i]]
        i = parents[i]
    return int(i)
