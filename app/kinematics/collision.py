"""What an arm touches: itself, its tool, the table, the spike, the fence.

The check sees what the operator sees. Every link is first one convex hull of what is drawn of it, which is
quick; only where two hulls come near are the drawn solids themselves compared, because a hull fills hollows.
Pairs that belong together are left out: neighbours, what touches at home, and pairs that may touch (tool tip
and spike).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import coal  # pyright: ignore[reportMissingImports]  (found through a .pth hook)
import numpy as np
import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)

from app.geometry.pose import Pose
from app.kinematics.robot import RobotModel
from app.kinematics.shapes import Shape
from app.kinematics.solids import outline, robot_shapes, solids

#: Pairs that may touch: that is what a touch is.
ALLOWED = (("tool tip", "spike"),)
_NEAR_AT_HOME = 0.004  # m: links this close at home are neighbours in fact
_NEAR = 0.02  # m: hulls nearer than this are looked at solid by solid
_LEAST_MARGIN = 1e-6  # m: at zero, solids with one centre are missed by rounding
_DISTANCE = coal.DistanceRequest()
_EXACT = {"box": lambda s: coal.Box(*s), "sphere": lambda s: coal.Sphere(*s)}


@dataclass(frozen=True)
class ContactPair:
    """Two bodies, by names an operator reads, and their distance [m]; below zero they overlap."""

    a: str
    b: str
    distance: float

    def sentence(self) -> str:
        return f"{self.a} touches {self.b}"


class CollisionWorld:
    """An arm, its tool and what stands around it. Not for two threads at once.

    Args:
        robot: the arm.
        tool_shapes: in the flange's frame; shapes of one link are one body.
        obstacles: in the base frame; every shape is a body of its own, named by its link.
        allowed: pairs of names that may touch.
        margin: bodies nearer than this count as touching [m].
    """

    def __init__(
        self,
        robot: RobotModel,
        *,
        tool_shapes: Sequence[Shape] = (),
        obstacles: Sequence[Shape] = (),
        allowed: Iterable[tuple[str, str]] = ALLOWED,
        margin: float = 0.0,
    ):
        self.robot, self._model, self._data = robot, robot.model, robot.model.createData()
        self._margin = margin
        moved = (*robot.joints, *robot.followers)
        self._ids = [0, *(robot.model.getJointId(joint.name) for joint in moved)]
        self._geometry = pin.GeometryModel()
        names: list[str] = []
        bodies: list[int] = []
        self._solids: list[list[coal.CollisionGeometry]] = []
        for body, name, hull, pose, drawn in _bodies(robot, tool_shapes, obstacles):
            self._geometry.addGeometryObject(
                pin.GeometryObject(f"{len(names)} {name}", self._ids[body], pin.SE3(pose.matrix), hull)
            )
            self._solids.append(drawn)
            names.append(name)
            bodies.append(body)
        arm = len(names) - len(obstacles)  # links and tool come first, what stands around comes last
        free = {frozenset(pair) for pair in allowed}
        candidates = [
            (i, j)
            for i in range(len(names))
            for j in range(i + 1, len(names))
            if abs(bodies[i] - bodies[j]) > (1 if j < arm else 0)
            and frozenset((names[i], names[j])) not in free
        ]
        self._names = names
        self._pairs = self._use(candidates, margin)
        neighbours = {
            (i, j)
            for (i, j), distance in zip(self._pairs, self._distances(robot.home), strict=True)
            if distance < _NEAR_AT_HOME and j < arm
        }
        self._pairs = self._use([pair for pair in self._pairs if pair not in neighbours], margin)

    def _use(self, pairs: list[tuple[int, int]], margin: float) -> list[tuple[int, int]]:
        self._geometry.removeAllCollisionPairs()
        for i, j in pairs:
            self._geometry.addCollisionPair(pin.CollisionPair(i, j))
        self._scratch = pin.GeometryData(self._geometry)
        for request in self._scratch.collisionRequests:
            request.security_margin = max(margin, _LEAST_MARGIN)
            request.num_max_contacts = 1
        spheres = [_sphere(thing.geometry) for thing in self._geometry.geometryObjects]
        self._centres = [centre for centre, _ in spheres]
        radii = np.array([radius for _, radius in spheres])
        self._first, self._second = np.array(pairs, int).reshape(-1, 2).T
        self._radii = radii[self._first] + radii[self._second]
        solids = [thing.geometry for thing in self._geometry.geometryObjects]
        self._planes = [(k, j) for k, (_, j) in enumerate(pairs) if isinstance(solids[j], coal.Halfspace)]
        return pairs

    @property
    def names(self) -> tuple[str, ...]:
        """Bodies, as messages name them."""
        return tuple(self._names)

    @property
    def pairs(self) -> tuple[tuple[str, str], ...]:
        """Pairs that are looked at."""
        return tuple((self._names[i], self._names[j]) for i, j in self._pairs)

    def check(self, q: np.ndarray) -> list[ContactPair]:
        """Pairs that touch at q (n,) [rad or m], deepest first; empty where the way is free."""
        return sorted(self._touching(q), key=lambda pair: pair.distance)

    def collides(self, q: np.ndarray) -> bool:
        """True where anything touches; stops at the first pair."""
        return next(self._touching(q), None) is not None

    def _touching(self, q: np.ndarray) -> Iterator[ContactPair]:
        q = np.asarray(q, float)
        if not pin.computeCollisions(self._model, self._data, self._geometry, self._scratch, q, False):
            return
        for k, result in enumerate(self._scratch.collisionResults):
            if result.isCollision():
                distance = self._apart(k)
                if distance <= self._margin:
                    i, j = self._pairs[k]
                    yield ContactPair(self._names[i], self._names[j], distance)

    def distance(self, q: np.ndarray) -> ContactPair | None:
        """The nearest pair at q (n,) and its distance [m]; None where there is no pair to look at.

        Farther than 20 mm it is the distance of hulls, a little less than that of what is drawn. Pairs are
        taken by the gap between the spheres around them, and no further than that can still matter.
        """
        if not self._pairs:
            return None
        pin.updateGeometryPlacements(
            self._model, self._data, self._geometry, self._scratch, np.asarray(q, float)
        )
        placements = self._scratch.oMg
        centres = np.array([placements[k].act(centre) for k, centre in enumerate(self._centres)])
        gaps = np.linalg.norm(centres[self._first] - centres[self._second], axis=1) - self._radii
        for k, plane in self._planes:  # a half-space has no sphere, but a height above it
            up = placements[plane].rotation[:, 2]
            gaps[k] = (centres[self._first[k]] - centres[plane]) @ up - self._radii[k]
        best, nearest = np.inf, 0
        for k in np.argsort(gaps).tolist():
            if gaps[k] >= best:
                break
            value = self._apart(k, best)
            if value < best:
                best, nearest = value, k
        i, j = self._pairs[nearest]
        return ContactPair(self._names[i], self._names[j], best)

    def _distances(self, q: np.ndarray) -> np.ndarray:
        """(pairs,) all distances [m]."""
        pin.updateGeometryPlacements(self._model, self._data, self._geometry, self._scratch, q)
        return np.array([self._apart(k) for k in range(len(self._pairs))])

    def _apart(self, k: int, best: float = np.inf) -> float:
        """Distance [m] of pair k where the geometry stands; exact only where it is below `best`."""
        hulls = float(pin.computeDistance(self._geometry, self._scratch, k).min_distance)
        i, j = self._pairs[k]
        if hulls >= min(best, _NEAR) or len(self._solids[i]) * len(self._solids[j]) == 1:
            return hulls
        here, there = (_transform(self._scratch.oMg[index]) for index in (i, j))
        least, result = np.inf, coal.DistanceResult()
        for a in self._solids[i]:
            for b in self._solids[j]:
                result.clear()
                least = min(least, coal.distance(a, here, b, there, _DISTANCE, result))
        return float(least)


def _bodies(robot: RobotModel, tool_shapes: Sequence[Shape], obstacles: Sequence[Shape]):
    """(body, name, hull, T_body_hull, solids in the hull's frame) of links, then tool, then obstacles."""
    drawn = robot_shapes(robot)
    chain = robot.chain
    T_body_flange = Pose.of(chain.flange_rotation, chain.flange_translation)
    held = [shape.moved(chain.steps[-1].body, T_body_flange) for shape in tool_shapes]
    links: dict[tuple[int, str], list[Shape]] = {}
    for shape in [*drawn, *held]:
        if shape.collides:
            links.setdefault((shape.body, _readable(shape.link)), []).append(shape)
    for (body, name), shapes in links.items():
        points = np.concatenate([s.T_body_shape.apply(outline(s)) for s in shapes])
        yield body, name, _hull(points), Pose.identity(), [_hull(s.points) for s in solids(shapes)]
    for shape in obstacles:
        solid = coal_solid(shape)
        yield 0, _readable(shape.link), solid, shape.T_body_shape, [solid]


def coal_solid(shape: Shape):
    """The solid of one shape in its own frame: exact where there is a primitive, else the hull of its points."""
    if shape.kind == "halfspace":
        return coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)
    if shape.kind == "cylinder" and shape.size[0] == shape.size[2]:
        return coal.Cylinder(shape.size[0], shape.size[1])
    exact = _EXACT.get(shape.kind)
    return exact(shape.size) if exact else _hull(outline(shape, chamfer=0.0))


def _hull(points: np.ndarray):
    vertices = coal.StdVec_Vec3s()
    for point in np.unique(points.round(6), axis=0):
        vertices.append(point)
    return coal.Convex.convexHull(vertices, True, "Qt")


def _transform(placement: pin.SE3) -> coal.Transform3s:
    return coal.Transform3s(placement.rotation, placement.translation)


def _sphere(solid) -> tuple[np.ndarray, float]:
    """A sphere around a solid, in its own frame; none is needed around a half-space."""
    if isinstance(solid, coal.Halfspace):
        return np.zeros(3), 0.0
    solid.computeLocalAABB()
    return np.array(solid.aabb_center), float(solid.aabb_radius)


def _readable(link: str) -> str:
    return link.replace("_", " ")
