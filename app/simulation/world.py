"""An arm with its true tool, a spike on a table, and a hand that touches the spike with noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.geometry import Pose, exp_so3
from app.kinematics import IkResult, RobotModel, solve_ik
from app.simulation.faults import Fault, Load, true_flange
from app.units import from_mm

#: One-sigma error of a careful hand, per axis.
TOUCH_SIGMA = from_mm(0.15)
#: Closer than this the tip counts as touching.
CONTACT_DISTANCE = from_mm(1.0)
#: Thickness of the ground plate on the table: flat, for tools that are taught on a plane.
PLATE = from_mm(6.0)
#: Where the spike stands where the description does not say: shares of the reach, ahead and up, best first.
_SPIKES = ((0.55, 0.20), (0.50, 0.28), (0.62, 0.28), (0.45, 0.38), (0.62, 0.12), (0.55, 0.45))
#: From the orientation at home [rad]: how the tip must be able to stand on it.
_TILTS = ((0.0, 0.0, 0.0), (0.6, 0.0, 0.0), (-0.6, 0.0, 0.0), (0.0, 0.6, 0.0), (0.0, -0.6, 0.0))
_LOOKS, _CLOSE = 8, from_mm(0.005)
#: A torch for arms whose description names no tool.
_PLAIN_TOOL = Pose.of(position=np.array([0.0, 0.0, from_mm(150.0)]))


@dataclass(frozen=True, eq=False)
class Picture:
    """What is drawn of a cell whose truth is to be found: a little beside it, so that the drawing gives nothing away.

    Args:
        T_flange_tool: the tool point that is drawn.
        p_base_spike: (3,) the spike that is drawn [m].
    """

    T_flange_tool: Pose
    p_base_spike: np.ndarray


@dataclass(frozen=True, eq=False)
class World:
    """What is true in the cell; a pendant only ever sees `shown_flange` and `hand`.

    Args:
        robot: the arm.
        T_flange_tool_true: the tool as it really is: its point and its axes.
        p_base_spike: (3,) tip of the spike [m].
        table_height: top of the table in base z [m].
        touch_sigma: one-sigma error of a touch, per axis [m].
        contact_distance: tip to spike below which they touch [m].
        T_flange_tool_active: the tool the controller reckons with (handle, jogging); None takes the true one.
        faults: what is wrong with the arm.
        load: what it carries, where that matters.
        row: number of the touch that comes next, from 1: some faults begin with a touch.
        picture: what is drawn, where it must not be the truth.
    """

    robot: RobotModel
    T_flange_tool_true: Pose
    p_base_spike: np.ndarray
    table_height: float
    touch_sigma: float = TOUCH_SIGMA
    contact_distance: float = CONTACT_DISTANCE
    T_flange_tool_active: Pose | None = None
    faults: tuple[Fault, ...] = ()
    load: Load | None = None
    row: int = 1
    picture: Picture | None = None

    def __post_init__(self):
        spike = np.array(self.p_base_spike, float)
        spike.flags.writeable = False
        object.__setattr__(self, "p_base_spike", spike)

    def shown_flange(self, q: np.ndarray) -> Pose:
        """T_base_flange as the controller computes it from its joint angles; q (n,)."""
        return self.robot.forward(q)

    def true_flange(self, q: np.ndarray) -> Pose:
        """T_base_flange as it really is while the controller shows `q` (n,)."""
        if not self.faults:
            return self.robot.forward(q)
        return _faulty_flange(self, np.asarray(q, float).tobytes())

    @property
    def T_flange_tool_hand(self) -> Pose:
        """The tool the controller moves: what somebody drags and jogs about."""
        return self.T_flange_tool_true if self.T_flange_tool_active is None else self.T_flange_tool_active

    def hand(self, q: np.ndarray) -> Pose:
        """T_base_tool as the controller reckons it; q (n,)."""
        return self.shown_flange(q) @ self.T_flange_tool_hand

    @property
    def p_base_spike_drawn(self) -> np.ndarray:
        """(3,) where the spike is drawn [m]."""
        return self.p_base_spike if self.picture is None else self.picture.p_base_spike

    def tip(self, q: np.ndarray) -> Pose:
        """T_base_tool of the true tool; q (n,)."""
        return self.true_flange(q) @ self.T_flange_tool_true

    def distance(self, q: np.ndarray) -> float:
        """True tip to spike [m]; q (n,)."""
        return float(np.linalg.norm(self.tip(q).position - self.p_base_spike))

    def touching(self, q: np.ndarray) -> bool:
        """True where the tip is in contact with the spike; q (n,)."""
        return self.distance(q) <= self.contact_distance

    @property
    def plate_height(self) -> float:
        """Upper face of the ground plate on the table, in base z [m]."""
        return self.table_height + PLATE

    def off(self, q: np.ndarray, roles: Sequence[str]) -> float:
        """How far the tip is from what it has to touch for a point of these roles [m]; 0 for none; q (n,)."""
        if "plane" in roles:
            return abs(float(self.tip(q).position[2]) - self.plate_height)
        return self.distance(q) if "touch" in roles else 0.0

    def touch(self, q: np.ndarray, rng: np.random.Generator) -> IkResult:
        """Brings the tip to the spike in the orientation it has, as well as a hand can.

        Args:
            q: (n,) where the arm is.
            rng: draws the hand's error.
        """
        aim = self.p_base_spike + rng.normal(0.0, self.touch_sigma, 3)
        return self._go(q, Pose.of(self.tip(q).rotation, aim))

    def bring(self, q: np.ndarray, aim: Pose, rng: np.random.Generator | None = None) -> IkResult:
        """Brings the tip to a place and an orientation, as well as a hand can.

        Args:
            q: (n,) where the arm is.
            aim: T_base_tip.
            rng: draws the hand's error; None makes none.
        """
        error = np.zeros(3) if rng is None else rng.normal(0.0, self.touch_sigma, 3)
        return self._go(q, Pose.of(aim.rotation, aim.position + error))

    def stroke(self, q: np.ndarray, axis: int, length: float, rng: np.random.Generator) -> IkResult:
        """Moves the tip along one of the true tool's axes without turning it, as well as a hand can.

        Args:
            q: (n,) where the stroke begins.
            axis: 0, 1 or 2.
            length: [m].
            rng: draws the hand's error.
        """
        start = self.tip(q)
        end = start.position + length * start.rotation[:, axis] + rng.normal(0.0, self.touch_sigma, 3)
        return self._go(q, Pose.of(start.rotation, end))

    def _go(self, q: np.ndarray, target: Pose) -> IkResult:
        """By the shown arm with the tool as it would have to be there; a faulty arm needs a second look or more."""
        result = None
        for _ in range(_LOOKS):
            at = q if result is None else result.q
            tool = self.shown_flange(at).inverse() @ self.tip(at)
            result = solve_ik(self.robot, target, at, T_flange_tool=tool, max_steps=200)
            missed = float(np.linalg.norm(self.tip(result.q).position - target.position))
            if not self.faults or not result.reached or missed < _CLOSE:
                break
        assert result is not None
        return result


@lru_cache(maxsize=64)
def _faulty_flange(world: World, q: bytes) -> Pose:
    """Asked several times for the same joints: for the tip, its distance, and what is drawn."""
    return true_flange(world.robot, np.frombuffer(q), world.faults, world.row, world.load)


@lru_cache(maxsize=64)
def default_world(robot: RobotModel) -> World:
    """The practice cell of an arm: its own tool, a spike within easy reach, a table under it. One for all who work in
    it: what is drawn of it and hit in it is worked out once."""
    cell = robot.description.get("cell", {})
    spike = cell.get("spike_mm")
    p_base_spike = from_mm(np.array(spike, float)) if spike is not None else np.array(_ahead(robot))
    table = from_mm(float(cell["table_mm"])) if "table_mm" in cell else float(0.6 * p_base_spike[2])
    return World(robot, default_tool(robot), p_base_spike, table)


def default_tool(robot: RobotModel) -> Pose:
    """T_flange_tool of the tool the arm's description comes with, else a plain torch straight ahead."""
    tool = robot.description.get("tool")
    if not tool:
        return _PLAIN_TOOL
    return Pose.from_quaternion(
        np.array(tool.get("quaternion_wxyz", (1.0, 0.0, 0.0, 0.0)), float),
        from_mm(np.array(tool["position_mm"], float)),
    )


@lru_cache(maxsize=16)
def _ahead(robot: RobotModel) -> tuple[float, float, float]:
    """A place before the arm as it stands at home, where the tip gets upright and tilted: makers do not agree which
    way ahead is, nor does every wrist reach the same places."""
    towards = robot.forward(robot.home).position[:2]
    length = np.linalg.norm(towards)
    direction = np.round(towards / length if length > 1e-3 else np.array([1.0, 0.0]), 1)
    direction /= np.linalg.norm(direction)
    reach = float(robot.description.get("reach_m", robot.reach))
    tool = default_tool(robot)
    upright = (robot.forward(robot.home) @ tool).rotation
    best, most = (0.0, 0.0, 0.0), -1
    for ahead, up in _SPIKES:
        place = np.array([*(ahead * reach * direction), up * reach])
        aims = [Pose.of(exp_so3(np.array(tilt)) @ upright, place) for tilt in _TILTS]
        reached = sum(
            solve_ik(robot, aim, robot.home, T_flange_tool=tool, max_steps=200).reached for aim in aims
        )
        if reached > most:
            best, most = (float(place[0]), float(place[1]), float(place[2])), reached
        if reached == len(aims):
            break
    return best
