"""A cell of two arms and a laser tracker, with its hidden truth."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace

import numpy as np

from app.calibration.base.maker import nominal_frame
from app.errors import DegenerateGeometryError
from app.geometry import Pose, rot_z
from app.kinematics import RobotModel, load_robot
from app.simulation.tracker import Capsule, LaserTracker, Sight
from app.units import from_deg, from_mm

_UPRIGHT = 0.3  # share of the reach: a flange nearer than this to axis 1 draws too small a circle
_THICK = 0.045  # share of the reach: radius of an arm's links
_NEST = from_mm(60.0)  # the reflector's centre in front of the flange
_ASIDE = from_mm(40.0)
_ABOVE = from_mm(150.0)  # an arm keeps this far from the floor
_TRIED = (from_deg(np.array([0.0, -60.0, -30.0, 30.0, 60.0])), from_deg(np.array([-45.0, -25.0, 25.0, 45.0])))


@dataclass(frozen=True, eq=False)
class CellArm:
    """One robot of the cell.

    Args:
        robot: its description.
        T_world_base: where it really stands, by the maker's frame.
        reflector: (3,) [m] its nest's centre in the flange.
        facing: (3,) unit, where the reflector looks, in the flange.
        rest: (n,) the zero position of the procedure [rad].
    """

    robot: RobotModel
    T_world_base: Pose
    reflector: np.ndarray
    facing: np.ndarray
    rest: np.ndarray

    @property
    def T_world_frame(self) -> Pose:
        """Where the patent's frame of this arm really is."""
        nominal = nominal_frame(self.robot)
        if nominal is None:
            raise DegenerateGeometryError(
                f"{self.robot.title}: axes 1 and 2 do not cross, so this procedure has no frame for it",
                code="parallel",
            )
        return self.T_world_base @ nominal[0]

    def flange(self, q: np.ndarray) -> Pose:
        """T_world_flange."""
        return self.T_world_base @ self.robot.forward(q)

    def capsules(self, q: np.ndarray, name: str) -> tuple[Capsule, ...]:
        """The arm as rods from joint to joint, the last one ending short of the flange."""
        frames = self.robot.chain.frames(np.asarray(q, float)[None])
        places = [np.zeros(3), *frames.joint_positions[0], frames.flange_positions[0]]
        world = self.T_world_base.apply(np.array(places))
        radius = _THICK * max(self.robot.reach, 0.3)
        out = []
        for start, end in itertools.pairwise(world):
            length = float(np.linalg.norm(end - start))
            if length > radius / 2:
                out.append(Capsule(start, end, radius, name))
        if out:  # the wrist is slimmer, and the nest sits on its end
            last = out[-1]
            out[-1] = replace(last, radius=radius / 2)
        return tuple(out)


@dataclass(frozen=True, eq=False)
class TrackerCell:
    """Two arms, a tracker, three nests on the floor.

    Args:
        arms: the two robots.
        tracker: where it stands now.
        nests: (k, 3) [m] fixed points in the world.
    """

    arms: tuple[CellArm, CellArm]
    tracker: LaserTracker
    nests: np.ndarray

    @property
    def T_base1_base2(self) -> Pose:
        """The hidden truth: the second arm's frame in the first one's, both as the patent defines them."""
        return self.arms[0].T_world_frame.inverse() @ self.arms[1].T_world_frame

    def moved(self, T_before_after: Pose) -> TrackerCell:
        """The same cell after somebody pushed the tracker."""
        tracker = replace(self.tracker, T_world_tracker=self.tracker.T_world_tracker @ T_before_after)
        return replace(self, tracker=tracker)

    def look(
        self, arm: int, postures: tuple[np.ndarray, np.ndarray], rng: np.random.Generator | None
    ) -> Sight:
        """Tries to measure the reflector of arm 0 or 1 while both stand in these postures."""
        flange = self.arms[arm].flange(postures[arm])
        obstacles = tuple(
            c for k, a in enumerate(self.arms) for c in a.capsules(postures[k], f"robot {k + 1}")
        )
        point = flange.apply(self.arms[arm].reflector)
        return self.tracker.look(point, flange.rotation @ self.arms[arm].facing, obstacles, rng)

    def nest(self, number: int, rng: np.random.Generator | None) -> Sight:
        """Measures a fixed point; the arms stand aside for it."""
        return self.tracker.look(self.nests[number], None, (), rng)

    def posture(self, arm: int, axis: int, angle: float) -> np.ndarray:
        """(n,) the zero position with one axis turned to `angle` [rad]."""
        q = self.arms[arm].rest.copy()
        if axis:
            q[axis - 1] = angle
        return q

    def _touches_floor(self, arm: int, q: np.ndarray) -> bool:
        capsules = self.arms[arm].capsules(q, "")[1:]
        return any(min(c.start[2], c.end[2]) < c.radius for c in capsules)

    def visible_angles(self, arm: int, axis: int, step: float, widest: float) -> np.ndarray:
        """Angles of one axis [rad] that the tracker sees and the floor allows, without a gap, `step` apart."""
        robot, rest = self.arms[arm].robot, self.arms[arm].rest[axis - 1]
        postures = [self.arms[0].rest, self.arms[1].rest]
        seen = []
        for direction in (1, -1):
            count = 0
            while (count + 1) * step <= widest + 1e-9:
                angle = rest + direction * (count + 1) * step
                if not robot.lower[axis - 1] <= angle <= robot.upper[axis - 1]:
                    break
                postures[arm] = self.posture(arm, axis, angle)
                if self._touches_floor(arm, postures[arm]):
                    break
                if not self.look(arm, (postures[0], postures[1]), None).seen:
                    break
                count += 1
            seen.append(count)
        return rest + step * np.arange(-seen[1], seen[0] + 1)


def zero_position(robot: RobotModel) -> np.ndarray:
    """The procedure's zero: all joints at zero, or the description's home with joint 1 at zero where an upright arm
    would hold its flange over axis 1."""
    for q in (np.clip(np.zeros(robot.joint_count), robot.lower, robot.upper), robot.home.copy()):
        q[0] = 0.0
        p = robot.forward(q).position
        if np.hypot(p[0], p[1]) > _UPRIGHT * robot.reach:
            return q
    q[1 : min(4, len(q))] += np.array([0.7, 0.5, 0.5])[: len(q) - 1]
    return np.clip(q, robot.lower, robot.upper)


def pedestal(robot: RobotModel, rest: np.ndarray) -> float:
    """How high an arm must stand for axis 2 to turn 50 degrees either way above the floor [m]."""
    lowest = _ABOVE
    for turn in from_deg(np.array([-50.0, -25.0, 0.0, 25.0, 50.0])):
        q = rest.copy()
        q[1] = np.clip(q[1] + turn, robot.lower[1], robot.upper[1])
        frames = robot.chain.frames(q[None])
        lowest = min(
            lowest, float(frames.flange_positions[0, 2]), float(frames.joint_positions[0, 1:, 2].min())
        )
    return min(_ABOVE - lowest + _ASIDE * 5, 0.8 * robot.reach) if lowest < _ABOVE else 0.0


def make_cell(first: str, second: str, seed: int) -> TrackerCell:
    """A cell of any two robots of the catalogue: they face each other, the tracker stands beside, nobody was exact.

    Args:
        first, second: names of robots.
        seed: draws where exactly everything stands.
    """
    rng = np.random.default_rng(seed)
    robots = (load_robot(first), load_robot(second))
    gap = 0.9 * (robots[0].reach + robots[1].reach)
    places = (np.zeros(3), np.array([gap, rng.uniform(-0.2, 0.2), rng.uniform(-0.05, 0.05)]))
    turns = (rng.uniform(-0.1, 0.1), np.pi + rng.uniform(-0.2, 0.2))
    far = 1.4 * max(r.reach for r in robots) + 1.2
    tracker = Pose.of(
        rot_z(np.pi / 2 + rng.uniform(-0.3, 0.3)), np.array([gap / 2, -far, rng.uniform(1.1, 1.4)])
    )
    arms = []
    for robot, place, turn in zip(robots, places, turns, strict=True):
        lean = Pose.exp(np.concatenate([place, rng.normal(0, from_deg(0.1), 3)]))
        rest = zero_position(robot)
        ahead = robot.forward(rest).position  # some makers' arms point along -X at zero
        lean = Pose.of(position=np.array([0.0, 0.0, pedestal(robot, rest)])) @ lean
        base = lean @ Pose.of(rot_z(turn - float(np.arctan2(ahead[1], ahead[0]))))
        arms.append(_with_nest(robot, base, rest, tracker))
    nests = np.array(
        [[gap / 2 - 0.3, 1.3, 0.05], [-0.6, -1.3, 0.05], [gap + 0.6, -1.3, 0.4], [gap / 2 + 0.5, 0.8, 0.5]]
    )
    return TrackerCell((arms[0], arms[1]), LaserTracker(tracker), nests + rng.normal(0, 0.02, (4, 3)))


def _with_nest(robot: RobotModel, base: Pose, rest: np.ndarray, tracker: Pose) -> CellArm:
    """The nest goes where the tracker sees it longest while axes 1 and 2 turn; the reflector looks at the tracker."""
    flange = base @ robot.forward(rest)
    towards = flange.rotation.T @ (tracker.position - flange.position)
    towards = towards / np.linalg.norm(towards)
    instrument = LaserTracker(tracker)
    postures = []
    for axis, angles in enumerate(_TRIED, 1):
        for angle in angles:
            q = rest.copy()
            q[axis - 1] += angle
            if robot.lower[axis - 1] <= q[axis - 1] <= robot.upper[axis - 1]:
                postures.append(q)
    best: tuple[float, CellArm] | None = None
    for far in (1.0, 2.0):
        for turn in np.arange(8) * np.pi / 4:
            side = np.array([np.cos(turn), np.sin(turn), 0.0])
            offset = side * far * (_ASIDE + _THICK * robot.reach) + np.array([0.0, 0.0, _NEST])
            arm = CellArm(robot, base, offset, towards, rest)
            seen = 0
            for q in postures:
                at = arm.flange(q)
                p, facing = at.apply(offset), at.rotation @ towards
                seen += instrument.look(p, facing, arm.capsules(q, ""), None).seen
            value = (
                seen + 0.3 * float(side @ towards) - 0.2 * far
            )  # among equals the near one, on the tracker's side
            if best is None or value > best[0]:
                best = (value, arm)
    assert best is not None
    return best[1]
