"""Conventions a recording may have been written down in by mistake, tried out one by one on a gross misfit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.effects.effect import Place
from app.diagnosis.models.kinematic.in_motion import evenly, joints_at
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.result import Parameter
from app.diagnosis.thresholds.conventions import HARDLY, MOST_APART, TURNS
from app.diagnosis.wording import note
from app.kinematics import RobotModel
from app.phrases import Said
from app.units import DEG_PER_RAD, MM_PER_CM, MM_PER_INCH, MM_PER_M

SIGN, SWAP, QUARTER, ANGLE_UNIT, LENGTH_UNIT, INVERSE, HORIZON, MIRROR, LATE, DELAY = (
    float(i) for i in range(10)
)
#: The kinds, the one that people mix up most first.
LIKELIHOOD = (SIGN, HORIZON, INVERSE, ANGLE_UNIT, LENGTH_UNIT, MIRROR, QUARTER, LATE, DELAY, SWAP)
#: Kinds that say nothing of the joints.
_OF_THE_INSTRUMENT = (LENGTH_UNIT, INVERSE, MIRROR)
#: A left-handed frame is a right-handed one whose last axis points the other way, up to where the instrument stands.
_MIRROR = np.array([1.0, 1.0, -1.0])
#: What brings lengths to the unit their column states, likeliest first.
_LENGTH_FACTORS = (MM_PER_M, 1.0 / MM_PER_M, MM_PER_CM, MM_PER_INCH)
#: Rows by which two devices that were started by hand are apart: one triggered once too often, or a head line was lost.
_ROWS_APART = (1.0, -1.0, 2.0, -2.0)


@dataclass(frozen=True)
class Convention:
    """One way the recording may be wrong: what it is and where it is reported to sit."""

    place: Place

    def undone(self, recording: StaticRecording, robot: RobotModel) -> StaticRecording:
        """The recording as it should have been written."""
        if self.place.fixed["kind"] == DELAY and not recording.situation.speed.any():
            return recording  # learnt in motion: an arm that stops for each row is where its row says
        if self.place.fixed["kind"] in _OF_THE_INSTRUMENT:
            return self.placed(recording)
        joints = converted_joints(recording.q, self.place.fixed, recording.situation.time)
        return self._timed(recording).with_joints(robot, joints)

    def _timed(self, recording: StaticRecording) -> StaticRecording:
        """The recording at the times its rows were measured."""
        if self.place.fixed["kind"] != DELAY or not self.place.fixed["even"]:
            return recording
        situation = recording.situation
        return replace(recording, situation=replace(situation, time=evenly(situation.time)))

    @property
    def needs_neighbours(self) -> bool:
        """True where what belongs to a row stands in another one, so that no row can be looked at by itself."""
        return self.place.fixed["kind"] in (LATE, DELAY)

    def placed(self, recording: StaticRecording) -> StaticRecording:
        """The same as far as base and tool go: loads and other drivers stay those of the joints as written."""
        fixed = self.place.fixed
        kind = fixed["kind"]
        if kind == LENGTH_UNIT:
            points = None if recording.points is None else recording.points * fixed["factor"]
            lengths = None if recording.lengths is None else recording.lengths * fixed["factor"]
            return replace(recording, points=points, lengths=lengths)
        if kind == MIRROR:
            assert recording.points is not None
            return replace(recording, points=recording.points * _MIRROR)
        if kind == INVERSE:
            assert recording.orientations is not None
            return replace(recording, orientations=np.swapaxes(recording.orientations, 1, 2))
        joints = converted_joints(recording.q, fixed, recording.situation.time)
        situation = replace(recording.situation, q=joints)
        return replace(recording, situation=situation)


def converted_joints(q: np.ndarray, fixed: Mapping[str, float], time: np.ndarray) -> np.ndarray:
    """(m, n) joint positions brought to the description's convention; others than joint kinds change nothing.

    Args:
        q: (m, n) as recorded, at times (m,) [s].
    """
    out = q.copy()
    kind, j, other = fixed.get("kind"), int(fixed.get("joint", 1)) - 1, int(fixed.get("other", 1)) - 1
    if kind == SIGN:
        out[:, j] = -q[:, j]
    elif kind == SWAP:
        out[:, [j, other]] = q[:, [other, j]]
    elif kind == QUARTER:
        out[:, j] = q[:, j] + fixed["turn"]
    elif kind == ANGLE_UNIT:
        out = q * fixed["factor"]
    elif kind == HORIZON:
        out[:, j] = q[:, j] + fixed["sense"] * q[:, other]
    elif kind == LATE:
        out = q[np.clip(np.arange(len(q)) - int(fixed["rows"]), 0, len(q) - 1)]
    elif kind == DELAY:
        stamped = evenly(time) if fixed["even"] else time
        out = joints_at(time, q, stamped - fixed["seconds"])
    return out


def likelihood_of(convention: Convention) -> int:
    """Rank of a convention among the mistakes people make, the commonest first."""
    return LIKELIHOOD.index(convention.place.fixed["kind"])


def title_of(place: Place) -> Said:
    """In words."""
    fixed = place.fixed
    kind = fixed["kind"]
    j, other = int(fixed.get("joint", 0)), int(fixed.get("other", 0))
    if kind == SIGN:
        return note("convention_sign", joint=j)
    if kind == SWAP:
        return note("convention_swap", joint=j, other=other)
    if kind == QUARTER:
        return note("convention_quarter", joint=j, turn=fixed["turn"] * DEG_PER_RAD)
    if kind == ANGLE_UNIT:
        return note("convention_angle_unit")
    if kind == HORIZON:
        return note("convention_horizon", joint=j, other=other)
    if kind == MIRROR:
        return note("convention_mirror")
    if kind == LATE:
        rows = int(fixed["rows"])
        return note("convention_late", rows=rows) if rows > 0 else note("convention_early", rows=-rows)
    if kind == DELAY:
        seconds = fixed["seconds"]
        return (
            note("convention_delay_even", seconds=seconds)
            if fixed["even"]
            else note("convention_delay", seconds=seconds)
        )
    if kind == LENGTH_UNIT:
        if fixed["factor"] == MM_PER_INCH:
            return note("convention_inches")
        if fixed["factor"] == MM_PER_CM:
            return note("convention_centimetres")
        return note("convention_length_unit")
    return note("convention_inverse")


def parameters_of(place: Place) -> tuple[Parameter, ...]:
    """What of a convention is a number that was measured; most are a choice."""
    fixed = place.fixed
    return (Parameter("delay", fixed["seconds"], fixed["std"], "s"),) if fixed["kind"] == DELAY else ()


def delayed(seconds: float, even: float, std: float = MOST_APART) -> Convention:
    """Measurements that belong to the joints some seconds before their time, or before the even course of the times."""
    fixed = {"kind": DELAY, "seconds": seconds, "even": even, "std": std}
    return Convention(Place({"body": "instrument"}, fixed))


def conventions(recording: StaticRecording, *, in_seconds: bool = False) -> Iterator[Convention]:
    """Everything that is tried, likeliest first.

    Args:
        in_seconds: True where delays in seconds are tried too: rows beside their joints are one of so many steps, and
            in seconds it holds at another rate and for an arm at rest.
    """
    prismatic = recording.situation.chain.prismatic
    joints = range(1, len(prismatic) + 1)
    for j in joints:
        yield Convention(Place({"joint": j}, {"kind": SIGN, "joint": float(j)}))
    # FANUC and arms with a parallel link count the forearm against the horizon and not against the upper arm
    for j in joints[1:]:
        if not prismatic[j - 1] and not prismatic[j - 2]:
            for sense in (1.0, -1.0):
                fixed = {"kind": HORIZON, "joint": float(j), "other": float(j - 1), "sense": sense}
                yield Convention(Place({"joint": j, "source_joint": j - 1}, fixed))
    if recording.orientations is not None:
        yield Convention(Place({"body": "instrument"}, {"kind": INVERSE}))
    if not prismatic.any():
        # Angles that are a fraction of a degree throughout, or tens of turns: else an arm that hardly moves fits all.
        largest = float(np.abs(recording.q).max())
        factors = [DEG_PER_RAD] * (largest < HARDLY) + [1.0 / DEG_PER_RAD] * (largest > TURNS)
        for factor in factors:
            yield Convention(Place({"body": "instrument"}, {"kind": ANGLE_UNIT, "factor": factor}))
    if recording.mode != "targets":
        for factor in _LENGTH_FACTORS:
            yield Convention(Place({"body": "instrument"}, {"kind": LENGTH_UNIT, "factor": factor}))
        for rows in () if in_seconds else _ROWS_APART:
            yield Convention(Place({"body": "instrument"}, {"kind": LATE, "rows": rows}))
    if recording.mode == "points" and recording.points is not None:
        yield Convention(Place({"body": "instrument"}, {"kind": MIRROR}))
    for j in joints:
        if not prismatic[j - 1]:
            for turn in (0.5 * np.pi, -0.5 * np.pi, np.pi):
                yield Convention(Place({"joint": j}, {"kind": QUARTER, "joint": float(j), "turn": turn}))
    for j in joints:
        for other in range(j + 1, len(prismatic) + 1):
            if prismatic[j - 1] == prismatic[other - 1]:
                fixed = {"kind": SWAP, "joint": float(j), "other": float(other)}
                yield Convention(Place({"joint": j, "source_joint": other}, fixed))
