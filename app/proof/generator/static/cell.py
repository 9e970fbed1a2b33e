"""What stands in the cell, what deviates in it, and where that puts the tool."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from app import catalog
from app.proof.generator.arm import Arm, Stance, point_jacobian, stance
from app.proof.generator.dynamics import GRAVITY, holding_torques
from app.proof.generator.effects.term import Term
from app.proof.generator.rotations import turn_vector

LAWS = "app.proof.generator.effects.static"
OUTSIDE = "app.proof.generator.effects.outside.static"
_KEPT: dict[tuple, tuple[Arm, Stance]] = {}
_MOST_KEPT = 4
WRITTEN = "wrong_convention"  # of what is shown, not of what is there


@dataclass(frozen=True, eq=False)
class Cell:
    """A recording before anything is wrong with it.

    Args:
        kind: touch or tracker.
        arm: the arm as it stands there (its geometry and masses may differ from the description).
        described: the arm as the description has it; directions of links are taken from here.
        q: (m, n) what the controller shows [rad or m].
        t: (m,) [s].
        tools: (s, k, 3) [m] k points on the tool, in the flange, of each session.
        views: (s, 4, 4) base in the instrument's frame, of each session.
        mounts: (s, 3, 3) measured body in the flange, of each session; the file does not tell it.
        session: (m,) which one each row belongs to.
        load_kg: (m,) declared load.
        load_at: (3,) [m] its centre in the flange.
        target: (m,) index of the target each row touched; zeros for a tracker.
        targets: (p, 3) [m] targets in the fixture's frame.
        fixture: (4, 4) fixture in base.
        targets_known: True where the file tells their coordinates.
        compliance: (n,) declared [rad/Nm], or None.
        torque_sensors: True where the file has joint torques.
        gravity: (3,) [m/s^2] in base; a base that leans has it elsewhere than the description.
        settling: rows a step takes until it is whole.
        approached: (m, n) sign of each joint's last move where rows do not follow each other directly; 0 where
            the rows tell it.
    """

    kind: str
    arm: Arm
    described: Arm
    q: np.ndarray
    t: np.ndarray
    tools: np.ndarray
    views: np.ndarray
    mounts: np.ndarray
    session: np.ndarray
    load_kg: np.ndarray
    load_at: np.ndarray
    target: np.ndarray
    targets: np.ndarray
    fixture: np.ndarray
    targets_known: bool = False
    compliance: np.ndarray | None = None
    torque_sensors: bool = False
    gravity: np.ndarray = field(default_factory=GRAVITY.copy)
    settling: int = 0
    approached: np.ndarray | None = None

    @property
    def m(self) -> int:
        return len(self.q)

    def at(self, q: np.ndarray) -> Cell:
        """The same cell with other joint positions."""
        return replace(self, q=q)

    @cached_property
    def holding(self) -> np.ndarray:
        """(m, n) torque that holds the arm with its declared load, at the positions shown."""
        return holding_torques(
            self.arm, self.q, gravity=self.gravity, load_kg=self.load_kg, load_at=self.load_at
        )

    @cached_property
    def last_move(self) -> np.ndarray:
        """(m, n) sign of the last change of each joint from row to row; 0 before it first moved in a session."""
        sign = np.zeros_like(self.q)
        for i in range(1, self.m):
            if self.session[i] != self.session[i - 1]:
                continue
            step = np.sign(self.q[i] - self.q[i - 1])
            sign[i] = np.where(step == 0, sign[i - 1], step)
            if self.approached is not None and self.approached[i].any():
                sign[i] = self.approached[i]
        return sign


@dataclass(eq=False)
class World:
    """Everything the effects add, row by row.

    Args:
        dq: (m, n) joints are really here minus what is shown.
        shifts, turns: (m, n+1, 3) of the joints' placements, axes of the link before [m, rad].
        base: (m, 3) displacement of the arm in base axes [m].
        base_turn: (m, 3) its turn about the base's origin, before the displacement, as a rotation vector [rad].
        tool: (m, 3) displacement of the tool points in the flange [m].
        scale: factor on what the instrument measures.
        reach: (m,) what the instrument reads too long along its beam [m].
        bend: what it reads too low at one metre, growing with the square of the distance [m].
        depth: how far the tip sinks in, along the flange's Z [m].
        flipped: (n,) -1 where the joint is shown with the wrong sign.
        torque: (m, n) torque on top of the described load [Nm].
    """

    dq: np.ndarray
    shifts: np.ndarray
    turns: np.ndarray
    base: np.ndarray
    base_turn: np.ndarray
    tool: np.ndarray
    reach: np.ndarray
    flipped: np.ndarray
    torque: np.ndarray
    scale: float = 1.0
    bend: float = 0.0
    depth: float = 0.0


def world_with(cell: Cell, terms: Sequence[Term]) -> World:
    """The world of a cell with these terms in it."""
    world = nothing(*cell.q.shape)
    _write(cell, terms, world)
    there = standing(cell, terms)
    for term in terms:
        if term.effect != WRITTEN:
            law_of(term.effect).add(there, term, world)
    return world


def _write(cell: Cell, terms: Sequence[Term], world: World) -> None:
    for term in terms:
        if term.effect == WRITTEN:
            law_of(term.effect).add(cell, term, world)


def standing(cell: Cell, terms: Sequence[Term]) -> Cell:
    """The cell at the positions its joints really have where they are shown by a wrong convention.

    What a joint carries, where its gear stands and which way it came from follow from these.
    """
    if not any(term.effect == WRITTEN for term in terms):
        return cell
    m, n = cell.q.shape
    world = nothing(m, n)
    _write(cell, terms, world)
    return cell.at(world.flipped * cell.q + world.dq)


def shown(cell: Cell, q: np.ndarray, terms: Sequence[Term]) -> Cell:
    """The cell that shows joints as the wrong conventions among `terms` write them when they really stand at `q`."""
    for term in reversed(terms):
        if term.effect == WRITTEN:
            q = law_of(term.effect).shown(term, q)
    return cell.at(q)


def nothing(m: int, n: int) -> World:
    """A world without effects."""
    return World(
        np.zeros((m, n)),
        np.zeros((m, n + 1, 3)),
        np.zeros((m, n + 1, 3)),
        np.zeros((m, 3)),
        np.zeros((m, 3)),
        np.zeros((m, 3)),
        np.zeros(m),
        np.ones(n),
        np.zeros((m, n)),
    )


def law_of(key: str):
    """A law of the library or from outside it, by key."""
    outside = catalog.members(OUTSIDE, "EFFECT")
    return outside[key] if key in outside else catalog.member(LAWS, "EFFECT", key, what="effect")


def true_stance(cell: Cell, world: World) -> Stance:
    """Where the arm really is; the last few are kept, as most of what deviates leaves the arm where it was."""
    q = world.flipped * cell.q + world.dq
    key = (id(cell.arm), q.tobytes(), world.shifts.tobytes(), world.turns.tobytes())
    if key not in _KEPT:
        if len(_KEPT) >= _MOST_KEPT:
            _KEPT.pop(next(iter(_KEPT)))
        # The arm is kept too: as long as it lives its id is no other's.
        _KEPT[key] = cell.arm, stance(cell.arm, q, world.shifts, world.turns)
    return _KEPT[key][1]


def tips(cell: Cell, world: World, where: Stance | None = None) -> np.ndarray:
    """(m, k, 3) tool points in the frame the base had at first [m]."""
    where = where or true_stance(cell, world)
    points = cell.tools[cell.session] + world.tool[:, None, :]
    placed = where.flange_places[:, None, :] + np.einsum("mij,mkj->mki", where.flange_rotations, points)
    if world.base_turn.any():
        placed = np.einsum("mij,mkj->mki", turn_vector(world.base_turn), placed)
    return placed + world.base[:, None, :]


def contact(cell: Cell, world: World) -> tuple[np.ndarray, np.ndarray]:
    """Where the tip first met the target (m, 3) [m], and how it moves with the joints as they are (m, 3, n)."""
    where = true_stance(cell, world)
    tip = tips(cell, world, where)[:, 0]
    stands = turn_vector(world.base_turn)
    unturned = np.einsum("mji,mj->mi", stands, tip - world.base)
    jacobian = stands @ point_jacobian(cell.arm, where, unturned)
    return tip - world.depth * where.flange_rotations[:, :, 2], jacobian


def goals(cell: Cell, world: World) -> np.ndarray:
    """(m, 3) where each row's target is, in base [m]; known coordinates carry the instrument's scale."""
    points = cell.targets[cell.target] / world.scale
    return points @ cell.fixture[:3, :3].T + cell.fixture[:3, 3]


def seen(cell: Cell, world: World) -> np.ndarray:
    """(m, k, 3) what the instrument reads, without noise [m]."""
    view = cell.views[cell.session]
    points = np.einsum("mij,mkj->mki", view[:, :3, :3], tips(cell, world)) + view[:, None, :3, 3]
    distance = np.linalg.norm(points, axis=-1, keepdims=True)
    low = world.bend * distance**2 * np.array([0.0, 0.0, -1.0])
    return (
        points * world.scale
        + world.reach[:, None, None] * points / np.where(distance > 0, distance, 1.0)
        + low
    )


def turned(cell: Cell, world: World) -> np.ndarray:
    """(m, 3, 3) the measured body's orientation in the instrument's frame, without noise."""
    stands = cell.views[cell.session][:, :3, :3] @ turn_vector(world.base_turn)
    return stands @ true_stance(cell, world).flange_rotations @ cell.mounts[cell.session]


def effect_on_points(cell: Cell, terms: Sequence[Term], term: Term) -> np.ndarray:
    """(m, k, 3) what one term does to the measured points beside the others, at the same joint positions [m]."""
    others = [t for t in terms if t is not term]
    if cell.kind == "tracker":
        return seen(cell, world_with(cell, [*others, term])) - seen(cell, world_with(cell, others))
    with_it, without = world_with(cell, [*others, term]), world_with(cell, others)
    gap = contact(cell, with_it)[0] - goals(cell, with_it)
    return (gap - contact(cell, without)[0] + goals(cell, without))[:, None, :]


def scaled_to(cell: Cell, terms: Sequence[Term], term: Term, rms: float) -> Term:
    """The term made as strong that it moves the tool point by `rms` [m] (root mean square of |p|)."""
    for _ in range(3):
        moved = effect_on_points(cell, [*terms, term], term)[:, 0]
        size = float(np.sqrt(np.mean(np.sum(moved**2, axis=1))))
        if size <= 1e-12:
            break
        term = term.times(rms / size)
    return term
