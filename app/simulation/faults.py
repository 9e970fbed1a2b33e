"""What is wrong with an arm in a cell: effects of the diagnosis' own library, applied exactly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from app import catalog
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity
from app.diagnosis.model import SavedModel
from app.diagnosis.models.kinematic.cell import nominal_cell, pose
from app.diagnosis.models.kinematic.situation import Situation, situation_for
from app.errors import UnknownNameError
from app.geometry import Pose
from app.kinematics import RobotModel

EFFECTS = "app.diagnosis.effects.kinematic"
#: Effects that no torque drives.
_WEIGHTLESS = frozenset({"joint_zero", "joint_slip", "link_length", "link_twist", "tool_slip", "base_shift"})
CONVENTION = "wrong_convention"
_FIXED = "fixed_"  # how a saved model marks values that choose a law's form


@dataclass(frozen=True)
class Fault:
    """One effect at one place.

    Args:
        effect: key in the library.
        where: as the effect takes it (`joint`, `link`, `body`, …; `from_row` is the touch from which on it is there).
        values: by the effect's own names of its parameters, SI.
        fixed: what chooses the law's form.

    Raises:
        UnknownNameError: no effect of this key.
    """

    effect: str
    where: Mapping[str, Any] = field(default_factory=dict)
    values: Mapping[str, float] = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict)

    @cached_property
    def law(self) -> KinematicEffect:
        return catalog.member(EFFECTS, "EFFECT", self.effect, what="effect")

    def checked(self, robot: RobotModel) -> Fault:
        """Itself, where the effect takes these parameters on this arm.

        Raises:
            UnknownNameError: a parameter the effect does not have; lists those it has.
        """
        names = [q.name for q in self.quantities(robot)]
        for name in self.values:
            if name not in names:
                raise UnknownNameError(name, available=names, what=f"parameter of {self.effect}")
        return self

    @property
    def place(self) -> Place:
        return Place(dict(self.where), dict(self.fixed))

    def quantities(self, robot: RobotModel) -> tuple[Quantity, ...]:
        """The parameters of the effect on this arm, with their units."""
        return self.law.quantities(situation_for(robot, robot.home[None]), self.place)


@dataclass(frozen=True)
class Load:
    """What hangs on the flange: mass [kg] and its centre (3,) in the flange [m]."""

    mass: float
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)


def faults_of(model: SavedModel) -> tuple[Fault, ...]:
    """What a diagnosis found, as faults of the arm in a cell. A step has happened already; a recording's wrong
    convention is no fault of the arm.

    Raises:
        UnknownNameError: an effect the library does not have.
    """
    out = []
    for effect in model.effects:
        if effect.effect == CONVENTION:
            continue
        where = {**effect.where, **({"from_row": 1} if "from_row" in effect.where else {})}
        fixed = {k.removeprefix(_FIXED): v for k, v in effect.parameters.items() if k.startswith(_FIXED)}
        values = {k: v for k, v in effect.parameters.items() if not k.startswith(_FIXED)}
        fault = Fault(effect.effect, where, values, fixed)
        catalog.member(EFFECTS, "EFFECT", fault.effect, what="effect in the saved model")
        out.append(fault)
    return tuple(out)


def true_flange(
    robot: RobotModel, q: np.ndarray, faults: tuple[Fault, ...], row: int, load: Load | None
) -> Pose:
    """T_base_flange as it really is while the controller shows q; what happened to the tool in its seat counts too.

    Args:
        q: (n,) [rad or m].
        row: number of the touch that is being made, from 1.
        load: what the arm carries.
    """
    if not faults:
        return robot.forward(q)
    situation = _situation(robot, np.asarray(q, float)[None], faults, row, load)
    cell = nominal_cell(situation)
    for fault in faults:
        names = [quantity.name for quantity in fault.law.quantities(situation, fault.place)]
        values = np.array([fault.values.get(name, 0.0) for name in names])
        cell = fault.law.apply(cell, situation, fault.place, values)
    posed = pose(situation, cell, np.zeros((1, 3)))
    return Pose.of(posed.hand[0], posed.points[0, 0])


def _situation(
    robot: RobotModel, q: np.ndarray, faults: tuple[Fault, ...], row: int, load: Load | None
) -> Situation:
    """The drivers at q (1, n); torques, which take longest, only where an effect may follow them."""
    order = np.array([row])
    if all(fault.effect in _WEIGHTLESS for fault in faults):
        return replace(_at_home(robot), q=q, order=order)
    if load is None:
        return situation_for(robot, q, order=order)
    centre = np.array(load.centre)
    return situation_for(robot, q, order=order, payload=np.array([load.mass]), payload_com=centre)


@lru_cache(maxsize=32)
def _at_home(robot: RobotModel) -> Situation:
    return situation_for(robot, robot.home[None])
