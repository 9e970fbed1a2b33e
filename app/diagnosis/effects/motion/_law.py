"""What an effect is: a law with exact torque and, for the search, the columns it is linear in."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from app.diagnosis.effects.motion._state import State

Where = Mapping[str, Any]
Values = Mapping[str, float]


@dataclass(frozen=True)
class Place:
    """Where an effect may sit, with the values its columns need and the fit may bend.

    Args:
        where: as the contract writes it; joints from 1.
        shape: values the law is not linear in.
    """

    where: Where
    shape: Values = field(default_factory=dict)


class Law(ABC):
    """Base of every effect.

    Attributes:
        key, title: its name, and for people.
        driver: what it follows, as the contract names drivers; "" where nothing.
        equation: the law as text.
        units: parameter -> unit.
        linear: names of the parameters the columns belong to, in their order.
        shape_bounds: shape parameter -> (lowest, highest).
        positive: parameters that cannot be below zero in an arm as such (a change since a reference can).
        windowed: True where it acts from a time on, or between two times.
        shared: True where it reaches every joint.
        follows_model: True where the columns are made of the predicted torque itself.
        corrected: True where the samples are corrected for it and looked at again.
        common: True where nearly every joint has it.
        resists: True where it holds a joint back by the joint's own speed.
        within: key of a simpler law on the same joint that this one contains.
    """

    key = ""
    title = ""
    driver = ""
    equation = ""
    units: ClassVar[Mapping[str, str]] = {}
    linear: ClassVar[Sequence[str]] = ()
    shape_bounds: ClassVar[Mapping[str, tuple[float, float]]] = {}
    positive: ClassVar[Sequence[str]] = ()
    windowed = False
    shared = False
    follows_model = False
    corrected = False
    common = False
    resists = False
    within = ""

    @abstractmethod
    def places(self, state: State) -> list[Place]:
        """Everywhere it could be in this log."""

    @abstractmethod
    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        """(m, k) on the joint named in `where`, or (m, n, k) where it is shared."""

    def values(self, coefficients: np.ndarray, shape: Values) -> dict[str, float]:
        """Parameters from the coefficients of the columns."""
        return {**dict(zip(self.linear, map(float, coefficients), strict=True)), **shape}

    def apply(
        self, state: State, where: Where, values: Values, torque: np.ndarray | None = None
    ) -> np.ndarray:
        """Exact torque the effect adds [Nm]: (m,) on its joint, or (m, n).

        Args:
            torque: (m, n) what the model predicts without it; None takes the description's.
        """
        shape = {k: v for k, v in values.items() if k not in self.linear}
        return self.columns(state, where, shape) @ np.array([values[k] for k in self.linear])

    def lawful(self, values: Values) -> bool:
        """False where the values are none a real arm can have."""
        return all(values[name] > 0 for name in self.positive)

    def explain(self, where: Where, values: Values) -> str:
        """One sentence for an operator."""
        place = f"Joint {where['joint']}" if "joint" in where else "The arm"
        numbers = ", ".join(
            f"{k} {v:.4g} {self.units[k]}".rstrip() for k, v in values.items() if k in self.units
        )
        return f"{place}: {self.title} ({numbers})."


class JointLaw(Law):
    """A law on one joint, the same at every joint that moves."""

    def shapes(self, state: State, joint: int) -> list[Values]:
        """Shape values to try on joint (from 0)."""
        return [{}]

    def places(self, state: State) -> list[Place]:
        where = {"driver": self.driver} if self.driver else {}
        return [
            Place({"joint": j + 1, **where}, shape)
            for j in range(state.joints)
            if state.moves(j)
            for shape in self.shapes(state, j)
        ]


def joint_of(where: Where) -> int:
    """The joint's index from 0."""
    return int(where["joint"]) - 1
