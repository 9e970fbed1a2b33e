"""What an effect is: places it can sit at, an exact law, its linear columns, and words."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from app.diagnosis.result import Parameter
from app.diagnosis.static.cell import Cell
from app.diagnosis.static.sensitivity import Sensitivity
from app.diagnosis.static.situation import Situation
from app.units import deg, mm

#: Unit at the edge -> factor from SI. Compound units are made of those of app.units.
EDGE = {
    "deg": deg(1.0),
    "mm": mm(1.0),
    "rad/Nm": 1.0,
    "mm/N": mm(1.0),
    "1": 1.0,
    "kg": 1.0,
    "m": 1.0,
    "deg/s": deg(1.0),
    "mm/s": mm(1.0),
    "deg/row": deg(1.0),
    "mm/row": mm(1.0),
    "1/s": 1.0,
    "1/row": 1.0,
    "1/K": 1.0,
    "deg/K": deg(1.0),
    "mm/K": mm(1.0),
    "s": 1.0,
}


@dataclass(frozen=True)
class Quantity:
    """A fitted parameter: its name, the unit a person reads, and physical bounds in SI."""

    name: str
    unit: str
    lower: float = -np.inf
    upper: float = np.inf


@dataclass(frozen=True)
class Place:
    """Where an effect can sit.

    Args:
        where: as reported.
        fixed: parameters that choose the law's form and are not fitted (a time constant, an order).
        scan: True where a starting row (`from_row`) is to be searched for.
    """

    where: Mapping[str, Any]
    fixed: Mapping[str, float] = field(default_factory=dict)
    scan: bool = False


class StaticEffect(ABC):
    """One effect. Files under app/diagnosis/effects/static hold one each, as `EFFECT`."""

    key: str
    title: str
    equation: str
    #: Lower comes first where two effects explain the same data exactly alike.
    rank: int = 50
    #: The driver whose curve is looked at before the name is given.
    curve: str | None = None

    @abstractmethod
    def places(self, situation: Situation) -> Iterable[Place]:
        """Everywhere it can sit on this arm, given what was recorded."""

    @abstractmethod
    def quantities(self, situation: Situation, place: Place) -> tuple[Quantity, ...]:
        """The fitted parameters there."""

    @abstractmethod
    def apply(self, cell: Cell, situation: Situation, place: Place, values: np.ndarray) -> Cell:
        """The cell with the effect in it, exactly.

        Args:
            values: in the order of `quantities`, SI.
        """

    @abstractmethod
    def columns(self, columns: Sensitivity, place: Place) -> np.ndarray:
        """(m, k, d): change of the prediction per unit of each parameter, whitened."""

    @abstractmethod
    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        """What an operator reads."""

    def report(
        self, situation: Situation, place: Place, values: np.ndarray, covariance: np.ndarray
    ) -> tuple[Parameter, ...]:
        """Values with one-sigma uncertainty, in the units a person reads."""
        std = np.sqrt(np.maximum(np.diag(covariance), 0.0))
        return tuple(
            Parameter(q.name, float(v) * EDGE[q.unit], float(s) * EDGE[q.unit], q.unit)
            for q, v, s in zip(self.quantities(situation, place), values, std, strict=True)
        )


def joints(situation: Situation) -> range:
    """Numbers of the joints, from 1."""
    return range(1, situation.joint_count + 1)


def angle_unit(situation: Situation, joint: int, per: str = "") -> str:
    """deg or mm by the joint's kind, with `per` ("/s") behind it."""
    return ("mm" if situation.chain.prismatic[joint - 1] else "deg") + per


def without_row(where: Mapping[str, Any]) -> dict[str, Any]:
    """A place without the row at which a step begins."""
    return {k: v for k, v in where.items() if k != "from_row"}


def masked(columns: np.ndarray, situation: Situation, place: Place) -> np.ndarray:
    """Columns cut to the rows from `from_row` on, where the place says one."""
    row = place.where.get("from_row")
    return columns if row is None else columns * situation.after(int(row))[:, None, None]


def since(situation: Situation, place: Place) -> np.ndarray:
    """(m,) 1 where the place's step has happened."""
    row = place.where.get("from_row")
    return np.ones(len(situation.q)) if row is None else situation.after(int(row))


def joint_driver(columns: Sensitivity, joint: int, driver: np.ndarray) -> np.ndarray:
    """(m, k, d) of joint `joint` (from 1) turned by driver (m,) or (m, d)."""
    driver = driver[:, None] if driver.ndim == 1 else driver
    return columns.joint[:, :, joint - 1, None] * driver[:, None, :]


def number(parameter: Parameter, digits: int = 3) -> str:
    """A value with its uncertainty, as a person writes it."""
    unit = "" if parameter.unit == "1" else f" {parameter.unit}"
    return f"{parameter.value:.{digits}g} ± {parameter.std:.1g}{unit}"


def joint_name(place: Place) -> str:
    """The joint of a place, as in `joint 3`."""
    return f"joint {place.where['joint']}"
