"""What is hidden in one attempt, drawn from its seed: the same seed hides the same."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.diagnosis.effects.effect import EDGE
from app.errors import UnknownNameError
from app.geometry import Pose, exp_so3
from app.kinematics import RobotModel
from app.session.state import robot_named
from app.simulation.faults import Fault, Load
from app.simulation.world import Picture, World, default_world
from app.training.exercise import Exercise, FaultPart, Hidden, exercise
from app.units import from_deg, from_mm

#: How far the drawn tip and the drawn spike stand beside the true ones [m].
BESIDE = from_mm(0.8)
_TURNED = from_deg(0.7)  # and how far the drawn tool is turned
_RIGHT = from_mm(0.3)  # a right tool in the controller is this good, per axis


@dataclass(frozen=True, eq=False)
class Truth:
    """The secret of one attempt.

    Args:
        world: the cell before anything happens in it.
        T_flange_tool_active: the tool in the controller, where there is one.
        spike_shift: (3,) [m] by which the spike is pushed; zeros where it is not.
        spike_from: the touch before which that happens.
        answer: what is wrong.
        number: of the touch or the joint it is about; 0 for none.
    """

    world: World
    T_flange_tool_active: Pose | None
    spike_shift: np.ndarray
    spike_from: int
    answer: str
    number: int


@lru_cache(maxsize=256)
def truth_of(key: str, seed: int) -> Truth:
    """The secret of an attempt; raises UnknownNameError."""
    return draw(exercise(key), seed)


def draw(chosen: Exercise, seed: int) -> Truth:
    """What this seed hides."""
    rng = np.random.default_rng([seed, 0x7EAC])
    robot = robot_named(chosen.robot)
    hidden, source = chosen.hidden, chosen
    if hidden.one_of:
        source = exercise(hidden.one_of[int(rng.integers(len(hidden.one_of)))])
    world = default_world(robot)
    nominal = world.T_flange_tool_true
    tool = Pose.of(
        exp_so3(from_deg(hidden.tool_turn_deg) * _inside(rng)) @ nominal.rotation,
        nominal.position + from_mm(hidden.tool_spread_mm) * rng.uniform(-1.0, 1.0, 3),
    )
    spike = world.p_base_spike + from_mm(hidden.spike_spread_mm) * rng.uniform(-1.0, 1.0, 3)
    picture = Picture(
        Pose.of(exp_so3(_TURNED * _direction(rng)) @ tool.rotation, tool.position + BESIDE * _direction(rng)),
        spike + BESIDE * _direction(rng),
    )
    wrong = source.hidden
    faults = tuple(_fault(part, robot, rng) for part in wrong.faults)
    shift = from_mm(wrong.spike_moved_mm) * _sideways(rng)
    since = int(rng.integers(wrong.spike_from[0], wrong.spike_from[1] + 1))
    load = Load(wrong.load_kg, tuple(from_mm(np.array(wrong.load_centre_mm)))) if wrong.load_kg else None
    active = _active(wrong if hidden.active == "right" and wrong.active == "wrong" else hidden, tool, rng)
    answer = source.question.answer if source.question else "nothing"
    number = {"touch": _row(faults) or (since if wrong.spike_moved_mm else 0), "joint": _joint(faults)}
    asked = source.question.number if source.question else ""
    return Truth(
        World(
            robot,
            tool,
            spike,
            world.table_height,
            touch_sigma=from_mm(hidden.touch_noise_mm),
            T_flange_tool_active=active or nominal,
            faults=faults,
            load=load,
            picture=picture,
        ),
        active,
        shift,
        since,
        answer,
        number.get(asked, 0),
    )


def _active(hidden: Hidden, tool: Pose, rng: np.random.Generator) -> Pose | None:
    """The tool the controller has: the right one to a calibration's accuracy, another torch's, or none."""
    near, far = _RIGHT * rng.normal(size=3), from_mm(hidden.wrong_by_mm) * _direction(rng)
    if hidden.active == "none":
        return None
    turned = exp_so3(_TURNED * _direction(rng)) @ tool.rotation
    return Pose.of(turned, tool.position + (near if hidden.active == "right" else far))


def _fault(part: FaultPart, robot: RobotModel, rng: np.random.Generator) -> Fault:
    where = dict(part.where)
    row = where.get("from_row")
    if isinstance(row, list | tuple):
        where["from_row"] = int(rng.integers(row[0], row[1] + 1))
    plain = Fault(part.effect, where, {}, part.fixed)
    known = {f"{q.name}_{q.unit.replace('/', '_')}": q for q in plain.quantities(robot)}
    values = {}
    for name, value in part.values.items():
        if name not in known:
            raise UnknownNameError(name, available=known, what=f"value of {part.effect}")
        sign = rng.choice([-1.0, 1.0]) if part.signs else 1.0
        quantity = known[name]
        drawn = value / EDGE.get(quantity.unit, 1.0) * rng.uniform(1.0 - part.spread, 1.0 + part.spread)
        values[quantity.name] = float(sign * drawn)
    return Fault(part.effect, where, values, part.fixed)


def _row(faults: tuple[Fault, ...]) -> int:
    return next((int(f.where["from_row"]) for f in faults if "from_row" in f.where), 0)


def _joint(faults: tuple[Fault, ...]) -> int:
    return next((int(f.where["joint"]) for f in faults if "joint" in f.where), 0)


def _direction(rng: np.random.Generator) -> np.ndarray:
    """(3,) a unit vector, no component small: what is hidden by it is hidden on every axis."""
    vector = rng.choice([-1.0, 1.0], 3) * rng.uniform(0.45, 1.0, 3)
    return vector / np.linalg.norm(vector)


def _inside(rng: np.random.Generator) -> np.ndarray:
    return _direction(rng) * rng.uniform(0.4, 1.0)


def _sideways(rng: np.random.Generator) -> np.ndarray:
    """(3,) a unit vector in the table's plane: a spike is pushed, not lifted."""
    angle = rng.uniform(0.0, 2.0 * np.pi)
    return np.array([np.cos(angle), np.sin(angle), 0.0])
