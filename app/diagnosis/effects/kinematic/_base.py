"""What effects on where a tool point is have in common: the types they work on, and small helpers."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Effect, Place, Quantity, joint_name
from app.diagnosis.models.kinematic.cell import Cell
from app.diagnosis.models.kinematic.sensitivity import Sensitivity
from app.diagnosis.models.kinematic.situation import Situation

__all__ = [
    "KinematicEffect",
    "Place",
    "Quantity",
    "angle_unit",
    "joint_driver",
    "joint_name",
    "joints",
    "masked",
    "moving",
    "nominal_compliance",
    "rms",
    "since",
]

#: rad or m: a joint whose angles spread by less than this (one sigma) does not move as far as any law can tell.
_STILL = 1e-3
#: rad (or m) at the rms load of the most loaded joint: wind-up of gears under an arm's own weight.
_WIND_UP = 2e-4
#: Share of the largest load by which the stiffness of a joint that carries less is guessed.
_LEAST_LOAD = 0.1


class KinematicEffect(Effect[Situation, Sensitivity, Cell]):
    """One effect on tool points. Files of this folder hold one each, as `EFFECT`."""


def joints(situation: Situation) -> range:
    """Numbers of the joints, from 1."""
    return range(1, situation.joint_count + 1)


def moving(situation: Situation) -> list[int]:
    """Numbers of the joints that move in this recording."""
    return [j for j in joints(situation) if situation.q[:, j - 1].std() > _STILL]


def rms(values: np.ndarray) -> float:
    """Root mean square; 1 where there is nothing, so that one may divide by it."""
    size = float(np.sqrt(np.mean(values**2))) if values.size else 0.0
    return size if size > 0 else 1.0


def nominal_compliance(situation: Situation, joint: int) -> float:
    """What joint `joint` (from 1) may give way [rad/Nm or m/N].

    Wrists carry less and are softer: between as stiff as the most loaded joint and as much wind-up as it.
    """
    loads = np.sqrt(np.mean(situation.torque**2, axis=0))
    largest = max(float(loads.max(initial=0.0)), 1e-12)
    return _WIND_UP / float(np.sqrt(max(float(loads[joint - 1]), _LEAST_LOAD * largest) * largest))


def angle_unit(situation: Situation, joint: int, per: str = "") -> str:
    """deg or mm by the joint's kind, with `per` ("/s") behind it."""
    return ("mm" if situation.chain.prismatic[joint - 1] else "deg") + per


def since(situation: Situation, place: Place) -> np.ndarray:
    """(m,) 1 where the place's step has happened."""
    row = place.where.get("from_row")
    return np.ones(len(situation.q)) if row is None else situation.after(int(row))


def masked(columns: np.ndarray, situation: Situation, place: Place) -> np.ndarray:
    """Columns cut to the rows from `from_row` on, where the place says one."""
    return columns if "from_row" not in place.where else columns * since(situation, place)[:, None, None]


def joint_driver(columns: Sensitivity, joint: int, driver: np.ndarray) -> np.ndarray:
    """(m, k, d) of joint `joint` (from 1) turned by driver (m,) or (m, d)."""
    driver = driver[:, None] if driver.ndim == 1 else driver
    return columns.joint[:, :, joint - 1, None] * driver[:, None, :]
