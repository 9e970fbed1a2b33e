"""What an effect of a joint log is: columns joint by joint, and the exact torque of its saved values."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from app.diagnosis.effects.described import Change, InJoint
from app.diagnosis.effects.effect import Effect, Place, Quantity
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, Read, Trial
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.kinematics import RobotModel

Where = Mapping[str, Any]
Values = Mapping[str, float]
#: Joint (from 0) -> (M, d) columns of its torque, or (M,) torque.
Torques = dict[int, np.ndarray]

#: Nominal size of a law on a joint: this share of the joint's root mean square torque.
SHARE = 0.3
#: How a saved law of dry friction keeps its sharpness [rad/s or m/s].
WIDTH = "fixed_width"
#: ... and the way over which it turns [rad or m], where that is not at once.
SLIP = "fixed_slip"
#: nats: a law is one decision among its kind; the choice of place and form is paid by `Place.cost`.
PENALTY = 4.0


class Law(Effect[State, State, np.ndarray]):
    """Base of every effect of a joint log.

    Attributes:
        driver: what it follows, as the contract names drivers; "" where nothing.
        units: parameter -> unit.
        linear: names of the parameters the columns belong to, in their order.
        positive: parameters that cannot be below zero in an arm as such.
        carried: True where its torque is part of what the gears carry (masses, loads, gravity): laws of load follow it.
        follows_load: True where its columns are made of the torque that the gears carry.
        ends: keys of `where` that hold the times between which it acts, or the one from which on; it is searched for
            over the log where there are any.
        until: key of `where` that holds the time at which it may be over again, of a law with one end.
        swells: True where it may rise and fall between its times, as half a sine.
        hidden: True for what friction of a joint that stands or creeps may hide: it must show where the joint moves.
        least_joints: an arm with fewer has no such thing.
        blunt: True where the direction of dry friction is in it: its sharpness is saved along.
        bent: shape value -> nepers to either side within which the fit may bend it.
        rough: shape value -> share of it by which the law's own simplifications may miss it.
        clashes: keys of laws that it is never in together with where it acts on the whole arm: no log tells them.
        contains: key of a law on the same joint whose columns this one has too: the two are never in together.
        series: True where several of them add up on a joint; more of those than a few are a curve, and no law.
        standstill: True where it acts in a joint that stands still.
        finding: False for what every arm has and no one is told of on its own.
        spread: of all its places as one family, variances over those of the nominal widths that are tried; the
            library's own where empty.
        certain: True where its widths are a covariance that was measured: no other is tried.
        sure: True where its nominal width is a trust: in an arm that is off everywhere it is off by as much.
        beside: key of a family that must be in before all its places are taken as one.
        gain: True where it scales what is recorded of a torque.
        stated: True where the description says it, as well as the header says: within that trust it needs no name.
        drifts: True where it is somewhat otherwise from one log of an arm to the next.
        likely: True for what most often changed between two logs of one arm: the search starts from it too.
        one_place: True where between two logs of one arm it changes at one place, and not everywhere.
        between_logs: how far its values may be off between two logs of one arm, over their nominal widths.
        apart: True where words say what other recording tells it from its rivals (`apart_` and its key).
        whole_log: True for a convention of the whole log, which has no columns: only `readings` offers it.
        both_sides: the driver by which it is told where motor and link angles are both recorded; "" for others.
        follows_commands: True where a joint that answers its commands late is told as it.
        added: key of the law that a change of the same columns is where it is a body fixed to the link.
        servo_alike: keys of laws on the same joint that look the same where a servo's error stands for its torque.
        in_joint: saved parameter -> the word a description of joints has for it, see `InJoint`.
        within: key of a simpler law on the same joint that must be in before this one is asked.
    """

    driver = ""
    units: ClassVar[Mapping[str, str]] = {}
    linear: ClassVar[Sequence[str]] = ()
    positive: ClassVar[Sequence[str]] = ()
    penalty = PENALTY
    carried = False
    follows_load = False
    ends: ClassVar[Sequence[str]] = ()
    until = ""
    swells = False
    hidden = False
    least_joints = 1
    blunt = False
    bent: ClassVar[Mapping[str, float]] = {}
    rough: ClassVar[Mapping[str, float]] = {}
    clashes: ClassVar[Sequence[str]] = ()
    contains = ""
    series = False
    standstill = False
    finding = True
    spread: ClassVar[Sequence[float]] = ()
    certain = False
    sure = False
    beside = ""
    gain = False
    stated = False
    drifts = False
    likely = False
    one_place = False
    between_logs = 1.0
    apart = False
    whole_log = False
    both_sides = ""
    follows_commands = False
    added = ""
    servo_alike: ClassVar[Sequence[str]] = ()
    in_joint: ClassVar[Mapping[str, str]] = {}
    within = ""

    @property
    def windowed(self) -> bool:
        """True where it acts from a time on, or between two times: it is searched for over the log."""
        return bool(self.ends)

    def beyond_trust(self, weights: np.ndarray) -> bool:
        """False for values (d,), in nominal widths, within the trust that the description deserves."""
        return True

    @abstractmethod
    def columns(self, columns: State, place: Place) -> Torques:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Joint -> (M, d): torque per unit of each linear parameter [Nm]."""

    def shape(self, state: State, place: Place) -> np.ndarray:
        """(M,) how much of it there is at each time (`windowed` only); its columns are those without times by that."""
        return np.ones(len(state.t))

    def quantities(self, situation: State, place: Place) -> tuple[Quantity, ...]:
        """The linear parameters; their nominal widths are measured on the log, see `widths`."""
        return tuple(Quantity(name, self.units.get(name, ""), 1.0) for name in self.linear)

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        """(d,) `SHARE` of the joint's torque for each column; the joint where that is least counts.

        Args:
            found: the columns, where they are known already.
        """
        found = self.columns(situation, place) if found is None else found
        size = np.full(len(self.quantities(situation, place)), np.inf)
        for joint, values in found.items():
            rms = np.sqrt(np.mean(values**2, axis=0))
            size = np.minimum(
                size, np.where(rms > 1e-12, SHARE * situation.size[joint] / np.maximum(rms, 1e-12), np.inf)
            )
        return np.where(np.isfinite(size), size, 1e-9)

    def block(self, state: State, place: Place) -> tuple[Torques, np.ndarray]:
        """Columns and their nominal widths."""
        found = self.columns(state, place)
        return found, self.widths(state, place, found)

    def described(
        self, robot: RobotModel, where: Mapping[str, Any], parameters: Mapping[str, float]
    ) -> tuple[Change, ...]:
        if not self.in_joint:
            return ()
        more = {word: parameters.get(name, 0.0) for name, word in self.in_joint.items()}
        return (InJoint(int(where["joint"]), more, parameters.get(WIDTH, 0.0), parameters.get(SLIP, 0.0)),)

    def turns(self) -> Mapping[int, tuple[float, float]]:
        """Joint (from 0) -> width [rad/s] and slip [rad] of the dry friction it is made of; none for most laws."""
        return {}

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        """Linear parameters (d,) and fixed values -> what is saved and reported."""
        return {**dict(zip(self.linear, map(float, values), strict=True)), **place.fixed}

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        """Exact torque [Nm], joint -> (M,), of saved parameters."""
        fixed = {k: v for k, v in parameters.items() if k not in self.linear}
        values = np.array([parameters[k] for k in self.linear])
        return {j: columns @ values for j, columns in self.columns(state, Place(where, fixed)).items()}

    def apply(self, cell: np.ndarray, situation: State, place: Place, values: np.ndarray) -> np.ndarray:
        """Torque (M, n) with the effect in it."""
        out = cell.copy()
        for joint, added in self.torque(situation, place.where, self.saved(place, values)).items():
            out[:, joint] += added
        return out

    def aliases(self, place: Place, joints: int) -> Sequence[tuple[str, Where]]:
        """Laws that no log of this arm alone tells from this one, key and place."""
        return ()

    def undo(self, hypothesis: Hypothesis, place: Place, values: np.ndarray) -> Hypothesis:
        """Another reading of the log, under which the effect with these linear values (d,) is gone (`undone` only)."""
        return hypothesis

    def readings(self, now: Hypothesis, read: Read) -> Iterable[Trial]:
        """Readings of the whole log to try on top of one, by what that leaves of its torques."""
        return ()

    def read_as(self, hypothesis: Hypothesis, where: Where, parameters: Values) -> Hypothesis:
        """A reading of the log with a saved effect taken into it (`undone` only)."""
        return hypothesis

    def between(self, now: Hypothesis, before: Hypothesis) -> Iterable[tuple[Where, Values]]:
        """Places and values of the effect by which one reading differs from another."""
        return ()

    def held(self, hypothesis: Hypothesis, place: Place) -> np.ndarray:
        """(d,) values [SI] by which its columns stand for what a reading holds of it already (`undone` only)."""
        return np.zeros(len(self.linear))

    def least(self, state: State, place: Place, name: str) -> float:
        """Below which a shape value is never bent."""
        return 0.0

    def lawful(self, parameters: Values) -> bool:
        """False where the values are none a real arm can have."""
        return all(parameters.get(name, 1.0) > 0 for name in self.positive)

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        """Parameters with one-sigma uncertainty; those that are not linear carry none."""
        std = dict(zip(self.linear, np.sqrt(np.maximum(np.diag(covariance), 0.0)), strict=True))
        return tuple(
            Parameter(name, float(value), float(std.get(name, 0.0)), self.units.get(name, ""))
            for name, value in self.saved(place, values).items()
            if not name.startswith("fixed_")
        )

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        """What an operator reads."""
        where = f"Joint {place.where['joint']}" if "joint" in place.where else "The arm"
        numbers = ", ".join(f"{p.name} {p.value:.4g} {p.unit}".rstrip() for p in parameters)
        return f"{where}: {self.title} ({numbers})."


class JointLaw(Law):
    """A law on one joint, the same at every joint that moves."""

    located_by = ("joint",)

    def forms(self, state: State, joint: int) -> list[tuple[Values, float]]:
        """Values that choose the form on joint (from 0), with the nats each choice costs."""
        return [({}, 0.0)]

    def places(self, situation: State) -> Iterable[Place]:
        where = {"driver": self.driver} if self.driver else {}
        return [
            Place({"joint": j + 1, **where}, fixed, cost=cost)
            for j in range(situation.joints)
            if situation.moves(j)
            for fixed, cost in self.forms(situation, j)
        ]

    def columns(self, columns: State, place: Place) -> Torques:
        joint = int(place.where["joint"]) - 1
        return {joint: self.column(columns, joint, place.fixed)}

    @abstractmethod
    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        """(M, d) on joint (from 0)."""


def direction(state: State, joint: int, fixed: Values) -> np.ndarray:
    """(M,) direction of dry friction between -1 and 1, of joint (from 0): as it was saved, or as the log tells."""
    slip = fixed.get(SLIP, 0.0) if WIDTH in fixed else None  # a law saved with its turn has all of it
    return state.direction(joint, fixed.get(WIDTH), slip)


def turn(state: State, *joints: int) -> dict[str, float]:
    """How dry friction of a joint (from 0), or of the sum of two speeds, turns on a log: what a saved law holds."""
    width = float(np.mean(state.width[list(joints)]))
    slip = float(np.mean(state.slip[list(joints)])) if np.all(state.slip[list(joints)] > 0) else 0.0
    return {WIDTH: width, **({SLIP: slip} if slip else {})}


def everywhere(values: np.ndarray) -> Torques:
    """(M, n, d) -> joint -> (M, d)."""
    return {j: values[:, j] for j in range(values.shape[1])}


def choice(count: int) -> float:
    """nats that the choice among so many forms costs."""
    return float(np.log(max(count, 1)))
