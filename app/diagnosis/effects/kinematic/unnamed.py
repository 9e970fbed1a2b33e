"""A smooth difference without a known law, at a place, along a driver."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    joint_driver,
    joints,
    moving,
)
from app.diagnosis.effects.kinematic._smooth import cosines, orders, smoothness, tensor
from app.diagnosis.models.kinematic.body import moved_base
from app.diagnosis.thresholds.evidence import UNKNOWN

#: rad (or m): size of its slowest wave.
_WIDTH = 3e-4
#: Share of the largest load below which a joint carries nothing.
_FELT = 1e-3
#: Cosines along a joint's own angle (three and a half waves over half a turn), and along its load.
_BY_ANGLE, _BY_LOAD = 14, 7
#: Half widths of the plays that a joint may trail in, in standard deviations of its angle.
_PLAYS = (0.2, 0.35, 0.5, 0.7)
#: Total order of products of cosines over the work space, and over the joints.
_SPACE_ORDER, _JOINT_ORDER = 3, 2
#: Joints that take part in a displacement over all joints (the first ones carry the others), and in a joint's curve
#: over several angles (the nearest: what drags or turns along with it sits beside it).
_MANY = 5


class Unnamed(KinematicEffect):
    """q_true = q + curve(driver) at one joint, or base displaced by a smooth function of position or joints.

    It names nothing: it says where a difference sits and what it follows, and takes it into the model.
    """

    key = "unnamed"
    title = "A difference without a known law"
    equation = "q_true = q + curve(driver), curve a sum of cosines"
    family = "unnamed"
    level = Level.UNKNOWN
    penalty = UNKNOWN
    cap = 4.0  # 1.2 mrad: slow curves beyond are lengths and zeros that cancel here, and not at other poses

    def places(self, situation) -> Iterator[Place]:
        for j in moving(situation):
            q = situation.q[:, j - 1]
            yield _place({"joint": j, "driver": "own_angle"}, q, _BY_ANGLE)
        for j in joints(situation):
            load = situation.torque[:, j - 1]
            if load.std() > _FELT * max(situation.torque.std(axis=0).max(), 1e-12):
                yield _place({"joint": j, "driver": "gravity_torque"}, load, _BY_LOAD)
        for j in moving(situation):
            q = situation.q[:, j - 1]
            fixed = {"spread": float(q.std()), "load": float(np.abs(situation.torque[:, j - 1]).max())}
            yield Place({"joint": j, "driver": "approach"}, fixed, member=False)
        for j in moving(situation):
            others = _nearest(moving(situation), j)
            fixed = {"order": float(_JOINT_ORDER)} | _range(situation.q[:, [k - 1 for k in others]])
            fixed |= {f"joint{d + 1}": float(k) for d, k in enumerate(others)}
            yield Place({"joint": j, "driver": "joints"}, fixed, member=False)
        for over, degree in (("space", _SPACE_ORDER), ("joints", _JOINT_ORDER)):
            values = _box(situation, over)
            fixed = {"order": float(degree)} | _range(values)
            yield Place({"body": "base", "driver": over}, fixed, member=False)

    def quantities(self, situation, place):
        if place.where["driver"] == "joints" and "joint" in place.where:
            sizes = _WIDTH / _orders(place).sum(axis=1)
            return tuple(Quantity(f"c{k + 1}", "1", float(s)) for k, s in enumerate(sizes))
        if place.where["driver"] == "approach":
            return tuple(Quantity(f"c{k + 1}", "1", _WIDTH) for k in range(2 * len(_PLAYS) + 1))
        if "joint" in place.where:
            sizes = _WIDTH * smoothness(int(place.fixed["count"]))
            return tuple(Quantity(f"c{k + 1}", "1", float(s)) for k, s in enumerate(sizes))
        which = _orders(place)
        sizes = _WIDTH / which.sum(axis=1)
        return tuple(
            Quantity(f"{axis}{b + 1}", "1", float(size)) for b, size in enumerate(sizes) for axis in "xyz"
        )

    def apply(self, cell, situation, place, values):
        if "joint" in place.where:
            return cell.add_joint(place.where["joint"] - 1, _curve(situation, place) @ values)
        field = _field(situation, place) @ values.reshape(-1, 3)
        return moved_base(cell, field)

    def columns(self, columns, place):
        if "joint" in place.where:
            return joint_driver(columns, place.where["joint"], _curve(columns.situation, place))
        field = _field(columns.situation, place)
        out = field[:, None, :, None] * columns.base[:, :, None, :3]
        return out.reshape(*columns.base.shape[:2], -1)

    def sentence(self, place, parameters):
        if "joint" in place.where:
            return f"Joint {place.where['joint']} is off along its {_DRIVER[place.where['driver']]}, by no known law."
        return "The tool point is off over the work space, by no known law."


_DRIVER = {
    "approach": "direction of approach",
    "own_angle": "own angle",
    "gravity_torque": "load",
    "joints": "own and the other joints' angles",
}


def _nearest(numbers: list[int], joint: int) -> list[int]:
    """The few of some joints that sit nearest to one, itself among them, in their order."""
    return sorted(sorted(numbers, key=lambda k: abs(k - joint))[:_MANY])


def _place(where: dict, driver: np.ndarray, count: int) -> Place:
    fixed = {"count": float(count), "low": float(driver.min()), "high": float(driver.max())}
    return Place(where, fixed, member=False)


def _range(values: np.ndarray) -> dict[str, float]:
    """Lowest and highest of every column of values (m, d)."""
    low = {f"low{d + 1}": float(v) for d, v in enumerate(values.min(axis=0))}
    return low | {f"high{d + 1}": float(v) for d, v in enumerate(values.max(axis=0))}


def _curve(situation, place) -> np.ndarray:
    """(m, d) the curve's columns; worked out once for a recording."""
    key = ("curve", *sorted(place.where.items()), *sorted(place.fixed.items()))
    if key not in situation.kept:
        situation.kept[key] = _fresh_curve(situation, place)
    return situation.kept[key]


def _fresh_curve(situation, place) -> np.ndarray:
    if place.where["driver"] == "joints":
        return _field(situation, place)
    if place.where["driver"] == "approach":
        return _trailing(situation, place)
    j = place.where["joint"] - 1
    values = situation.q[:, j] if place.where["driver"] == "own_angle" else situation.torque[:, j]
    fixed = place.fixed
    return cosines(values, fixed["low"], fixed["high"], int(fixed["count"]))


def _trailing(situation, place) -> np.ndarray:
    """(m, 2 p + 1): where the joint stands in plays of several widths (a hysteron each), and approach times load."""
    j = place.where["joint"] - 1
    q, widths = situation.q[:, j], np.array(_PLAYS) * max(place.fixed["spread"], 1e-9)
    inside = np.column_stack([_in_play(q.tolist(), w) for w in widths.tolist()])
    loaded = situation.approach[:, j] * np.abs(situation.torque[:, j]) / max(place.fixed["load"], 1e-9)
    return np.column_stack([inside, inside * np.abs(inside), loaded])


def _in_play(q: list[float], half: float) -> np.ndarray:
    """(m,) where in a play of this half width the joint stands, between -1 and 1; row by row, as it was moved."""
    centre, out = q[0], []
    for now in q:
        centre = min(max(centre, now - half), now + half)
        out.append((now - centre) / half)
    return np.array(out)


def _box(situation, over: str) -> np.ndarray:
    """(m, d) what a displacement over space or joints follows."""
    if over == "space":
        return situation.chain.frames(situation.q).flange_positions
    return situation.q[:, : min(_MANY, situation.joint_count)]


def _orders(place) -> np.ndarray:
    dimensions = sum(name.startswith("low") for name in place.fixed)
    return orders(dimensions, int(place.fixed["order"]))


def _field(situation, place) -> np.ndarray:
    values = _box(situation, place.where["driver"])
    chosen = [int(place.fixed[k]) - 1 for k in sorted(place.fixed) if k.startswith("joint")]
    values = situation.q[:, chosen] if chosen else values
    low = np.array([place.fixed[f"low{d + 1}"] for d in range(values.shape[1])])
    high = np.array([place.fixed[f"high{d + 1}"] for d in range(values.shape[1])])
    return tensor(values, low, high, _orders(place))


EFFECT = Unnamed()
