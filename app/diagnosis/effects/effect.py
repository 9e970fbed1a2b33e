"""What an effect is, for touches, tracker points and joint logs alike: everything the engine may ask of one.

An effect's file is all it needs. The engine never asks for a key; it asks for capabilities.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from app.diagnosis.effects.described import Change
from app.diagnosis.result import Parameter
from app.diagnosis.thresholds.evidence import LAW
from app.kinematics import RobotModel
from app.units import deg, mm

#: Unit at the edge -> factor from SI. Units that are SI themselves are not listed.
EDGE = {
    "deg": deg(1.0),
    "mm": mm(1.0),
    "mm/N": mm(1.0),
    "deg/s": deg(1.0),
    "mm/s": mm(1.0),
    "deg/row": deg(1.0),
    "mm/row": mm(1.0),
    "deg/K": deg(1.0),
    "mm/K": mm(1.0),
}


class Level(IntEnum):
    """In which order laws are thought of: what has no name keeps only what no named law can take."""

    CALIBRATION = 0
    MECHANISM = 1
    UNKNOWN = 2


@dataclass(frozen=True)
class Quantity:
    """A fitted parameter.

    Args:
        name: as reported and saved.
        unit: as a person reads it (a key of EDGE, or an SI unit).
        width: nominal one-sigma size in arms as they are built, SI.
        lower, upper: physical bounds, SI.
    """

    name: str
    unit: str
    width: float
    lower: float = -np.inf
    upper: float = np.inf


@dataclass(frozen=True)
class Place:
    """Where an effect can sit.

    Args:
        where: as reported.
        fixed: values that choose the law's form and are not linear (a time constant, an order).
        scan: True where a starting row or time is to be searched for.
        cost: nats for the choice of this place among alternatives of form, beyond the effect's penalty.
        member: True where it takes part in its family when the whole family is in.
        alone: False where it is never taken but as part of its family.
    """

    where: Mapping[str, Any]
    fixed: Mapping[str, float] = field(default_factory=dict)
    scan: bool = False
    cost: float = 0.0
    member: bool = True
    alone: bool = True

    def at(self, **where: Any) -> Place:
        """The same place with more said of where."""
        return Place({**self.where, **where}, self.fixed, self.scan, self.cost, self.member, self.alone)


Situation = TypeVar("Situation")
Columns = TypeVar("Columns")
Cell = TypeVar("Cell")


class Effect(ABC, Generic[Situation, Columns, Cell]):
    """One effect.

    Attributes:
        key: its name in the contract.
        title: for people.
        equation: the law as text.
        family: its line in the error budget.
        level: what it may not take from others, see Level.
        penalty: nats that it costs to name it.
        cap: largest learnt width, in multiples of the nominal one.
        whole: True where all its places together form part of a family that is tried as a whole.
        always: True where members stay in a fit of families even if their width shrinks to nothing.
        built: True for what comes from how an arm was built and set up: arms are off in all of it.
        group: name of those that share one learnt width; empty for the effect's own.
        serving: True where it only allows for what another law cannot know; it is never named.
        undone: True where it is taken out of the recording before anything is fitted (a convention, a delay).
        lasting: False for events of one recording, which a model does not carry to another; see `lasts`.
        moves_base: True where it puts the whole base elsewhere, however far.
        no_words: why a description of rigid bodies has none for it, where its name does not say that.
        located_by: keys of `where` that its place has to name; empty where it may stand for the whole arm.
    """

    key: str
    title: str
    equation: str
    family: str
    level: Level = Level.CALIBRATION
    penalty: float = LAW
    cap: float = 10.0
    whole: bool = False
    always: bool = False
    built: bool = False
    group: str = ""
    serving: bool = False
    undone: bool = False
    lasting: bool = True
    moves_base: bool = False
    no_words: str = ""
    located_by: ClassVar[Sequence[str]] = ()

    @abstractmethod
    def places(self, situation: Situation) -> Iterable[Place]:
        """Everywhere it can sit on this arm, given what was recorded."""

    @abstractmethod
    def quantities(self, situation: Situation, place: Place) -> tuple[Quantity, ...]:
        """The fitted parameters there."""

    @abstractmethod
    def columns(self, columns: Columns, place: Place) -> np.ndarray:
        """(m, k, d): change of what is measured per unit of each parameter, weighted like the residual."""

    @abstractmethod
    def apply(self, cell: Cell, situation: Situation, place: Place, values: np.ndarray) -> Cell:
        """The model of the arm with the effect in it, exactly.

        Args:
            values: in the order of `quantities`, SI.
        """

    @abstractmethod
    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        """What an operator reads."""

    def described(
        self, robot: RobotModel, where: Mapping[str, Any], parameters: Mapping[str, float]
    ) -> tuple[Change, ...]:
        """What a description of rigid bodies has words for of the effect as it was saved; () where it has none."""
        return ()

    def impossible(self, parameters: Mapping[str, float]) -> tuple[str, str] | None:
        """The first saved value that no arm has, by name, and what it could be; None where all may be."""
        return None

    def lasts(self, where: Mapping[str, Any]) -> bool:
        """False for what happened once, in its own recording: an event, or what begins at a row or a time."""
        return self.lasting and "from_row" not in where and "from_s" not in where

    def widths(self, situation: Situation, place: Place) -> np.ndarray:
        """(d,) nominal one-sigma sizes, SI."""
        return np.array([q.width for q in self.quantities(situation, place)])

    def report(
        self, situation: Situation, place: Place, values: np.ndarray, covariance: np.ndarray
    ) -> tuple[Parameter, ...]:
        """Values with one-sigma uncertainty, in the units a person reads.

        Args:
            values: (d,) SI.
            covariance: (d, d) SI.
        """
        std = np.sqrt(np.maximum(np.diag(covariance), 0.0))
        return tuple(
            Parameter(q.name, float(v) * EDGE.get(q.unit, 1.0), float(s) * EDGE.get(q.unit, 1.0), q.unit)
            for q, v, s in zip(self.quantities(situation, place), values, std, strict=True)
        )


def joint_name(place: Place) -> str:
    """The joint of a place, as in `joint 3`."""
    return f"joint {place.where['joint']}"
