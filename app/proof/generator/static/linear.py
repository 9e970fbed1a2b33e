"""What small changes do to the readings, by levers: one product a column instead of a walk through the arm.

The readings are linear in everything that is small, about the arm as it really is. A joint that is off by dq moves
a point by its axis times the lever, a link's shift moves it as it is, a link's turn by the turn times the lever.
columns.py has the same by differences of the exact model; the tests hold them against each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from app.proof.generator.arm import point_jacobian
from app.proof.generator.dynamics import GRAVITY
from app.proof.generator.effects.term import Term
from app.proof.generator.rotations import cross
from app.proof.generator.static.cell import (
    Cell,
    World,
    contact,
    goals,
    law_of,
    nothing,
    seen,
    shown,
    standing,
    tips,
    true_stance,
    turned,
    world_with,
)
from app.proof.generator.static.making import ORIENTATION_SIGMA, Made
from app.proof.generator.static.poses import newton_step

UNIT = 1e-6  # m, rad: the strength at which a law's world is taken; it is divided out again


class Levers:
    """Readings of one recording, linearised where the arm really is.

    Readings are (m, c), in units of the noise; the first `points` components of a row are of points, the
    others of orientation.
    """

    def __init__(self, made: Made):
        self.made, self.terms = made, made.terms
        self.cell: Cell = _met(made) if made.plan.kind == "touch" else made.cell
        self.there: Cell = standing(self.cell, made.terms)
        self.world: World = world_with(self.cell, made.terms)
        self.stance = true_stance(self.cell, self.world)
        self.tips = tips(self.cell, self.world, self.stance)
        m = self.cell.m
        self.before = np.concatenate(
            [np.tile(np.eye(3), (m, 1, 1, 1)), self.stance.rotations], axis=1
        )  # of the link before joint k; the last: before the flange
        self.origins = np.concatenate([self.stance.places, self.stance.flange_places[:, None]], axis=1)
        self.points = 1 if made.lengths is not None else 3 * self.tips.shape[1]

    @cached_property
    def jacobians(self) -> np.ndarray:
        """(m, k, 3, n) of every tool point."""
        each = [
            point_jacobian(self.cell.arm, self.stance, self.tips[:, i]) for i in range(self.tips.shape[1])
        ]
        return np.stack(each, axis=1)

    @cached_property
    def read(self) -> np.ndarray:
        """(m, k, 3) what the instrument would read without noise [m]."""
        return seen(self.cell, self.world)

    @cached_property
    def error(self) -> np.ndarray:
        """(m, c) what was measured minus what is true: the noise that is in the recording."""
        made, cell = self.made, self.cell
        sigma = made.plan.noise
        if cell.kind == "touch":
            noisy = world_with(made.cell, made.terms)
            return (contact(made.cell, noisy)[0] - goals(made.cell, noisy)) / sigma
        points = seen(cell, self.world)
        if made.lengths is not None:
            return (made.lengths - np.linalg.norm(points[:, 0], axis=1))[:, None] / sigma
        parts = [(made.points - points).reshape(len(points), -1) / sigma]
        if made.orientations is not None:
            parts.append(_small_turn(made.orientations, turned(cell, self.world)) / ORIENTATION_SIGMA)
        return np.hstack(parts)

    def missing(self, terms: Sequence[Term]) -> np.ndarray:
        """(m, c) what readings without noise hold that an arm with only these terms does not: exact."""
        cell, other = self.cell, world_with(self.cell, terms)
        sigma = self.made.plan.noise
        if cell.kind == "touch":
            gap = contact(cell, self.world)[0] - goals(cell, self.world)
            return (gap - contact(cell, other)[0] + goals(cell, other)) / sigma
        true, said = seen(cell, self.world), seen(cell, other)
        if self.made.lengths is not None:
            lengths = [np.linalg.norm(points[:, 0], axis=1, keepdims=True) for points in (true, said)]
            return (lengths[0] - lengths[1]) / sigma
        parts = [(true - said).reshape(len(true), -1) / sigma]
        if self.made.orientations is not None:
            parts.append(_small_turn(turned(cell, self.world), turned(cell, other)) / ORIENTATION_SIGMA)
        return np.hstack(parts)

    @cached_property
    def told(self) -> Cell:
        """The cell as the file and the description tell it: loads, the base's lean, where rows are come from."""
        arm, said = self.there.arm, self.there.described
        arm = arm.changed(masses=said.masses, coms=said.coms, inertias=said.inertias)
        return replace(self.there, arm=arm, gravity=GRAVITY, approached=None, settling=0)

    @property
    def misled(self) -> bool:
        """True where the file or the description does not tell all."""
        cell = self.cell
        moved = bool(np.any(cell.gravity != GRAVITY)) or cell.approached is not None or cell.settling > 0
        return moved or not np.array_equal(cell.arm.masses, cell.described.masses)

    def column(self, term: Term, name: str, *, told: bool = False) -> np.ndarray:
        """(m, c) the change of the readings per unit of one parameter of a term.

        Args:
            told: as one reckons it who has only the file and the description.
        """
        world = nothing(*self.cell.q.shape)
        only = replace(term, parameters={k: UNIT if k == name else 0.0 for k in term.parameters})
        if term.effect == "payload":
            only = replace(term, parameters={**term.parameters, "mass": UNIT})
        law_of(term.effect).add(self.told if told else self.there, only, world)
        return self._of(world) / UNIT

    def columns(self, terms: Sequence[Term], *, told: bool = False) -> np.ndarray:
        """(m c, p) every parameter of every term."""
        each = [self.column(t, name, told=told).ravel() for t in terms for name in free_names(t)]
        return np.stack(each, axis=1) if each else np.zeros((self.error.size, 0))

    def opened(self) -> np.ndarray:
        """(m c, p) what a recording leaves open: base or fixture, tool, touched points, mount."""
        cell, m = self.cell, self.cell.m
        columns = []
        for s in range(len(cell.tools)):
            rows = (cell.session == s)[:, None, None] * np.ones((m, self.tips.shape[1], 1))
            for k in range(self.tips.shape[1]):
                for axis in range(3):
                    moved = np.zeros((m, self.tips.shape[1], 3))
                    moved[:, k] = self.stance.flange_rotations[:, :, axis]
                    columns.append(self._reading(moved * rows))
            if cell.kind == "tracker":
                for axis in range(3):
                    along = np.broadcast_to(np.eye(3)[axis], self.tips.shape)
                    columns.append(self._reading(along * rows))
                    spun = np.broadcast_to(np.eye(3)[axis], (m, 3))
                    columns.append(self._reading(cross(along, self.tips) * rows, spun * rows[:, 0]))
                    held = self.stance.flange_rotations[:, :, axis] * rows[:, 0]
                    if self.made.orientations is not None:
                        columns.append(self._reading(np.zeros(self.tips.shape), held))
        if cell.kind == "touch" and cell.targets_known:
            for axis in range(3):
                along = np.broadcast_to(np.eye(3)[axis], self.tips.shape)
                columns += [self._reading(along), self._reading(cross(along, self.tips))]
        elif cell.kind == "touch":
            for p in range(len(cell.targets)):
                rows = (cell.target == p)[:, None, None]
                columns += [
                    self._reading(np.eye(3)[axis] * rows * np.ones(self.tips.shape)) for axis in range(3)
                ]
        return np.stack([c.ravel() for c in columns], axis=1)

    def kept(self) -> np.ndarray:
        """(m c,) True for readings of rows that did not go wrong."""
        good = ~np.isin(np.arange(self.cell.m), self.made.outliers)
        return np.repeat(good, self.error.shape[1])

    def of_points(self) -> np.ndarray:
        """(m c,) True for readings of points."""
        return np.tile(np.arange(self.error.shape[1]) < self.points, self.cell.m)

    def _of(self, world: World) -> np.ndarray:
        """(m, c) the change of the readings in a world that holds little."""
        moved = np.einsum("mkij,mj->mki", self.jacobians, world.dq)
        spun = np.einsum("mjk,mj->mk", self.stance.axes * ~self.cell.arm.slides[None, :, None], world.dq)
        for k in np.flatnonzero(np.any(world.shifts, axis=(0, 2))):
            moved = moved + np.einsum("mij,mj->mi", self.before[:, k], world.shifts[:, k])[:, None]
        for k in np.flatnonzero(np.any(world.turns, axis=(0, 2))):
            by = np.einsum("mij,mj->mi", self.before[:, k], world.turns[:, k])
            moved = moved + cross(by[:, None], self.tips - self.origins[:, k, None])
            spun = spun + by
        moved = moved + np.einsum("mij,mj->mi", self.stance.flange_rotations, world.tool)[:, None]
        moved = moved + cross(world.base_turn[:, None], self.tips) + world.base[:, None]
        spun = spun + world.base_turn
        if world.depth:
            moved = moved - world.depth * self.stance.flange_rotations[:, None, :, 2]
        out = self._reading(moved, spun)
        if self.cell.kind == "touch":
            away = self.cell.targets[self.cell.target] @ self.cell.fixture[:3, :3].T
            return out + (world.scale - 1.0) * away / self.made.plan.noise
        reads = world.scale != 1.0 or world.bend or world.reach.any()
        return out + self._instrument(world) if reads else out

    def _instrument(self, world: World) -> np.ndarray:
        """(m, c) what the instrument adds of its own."""
        points = self.read
        distance = np.linalg.norm(points, axis=-1, keepdims=True)
        low = world.bend * distance**2 * np.array([0.0, 0.0, -1.0])
        added = (world.scale - 1.0) * points + world.reach[:, None, None] * points / distance + low
        return self._seen(added, np.zeros((self.cell.m, 3)))

    def _reading(self, moved: np.ndarray, spun: np.ndarray | None = None) -> np.ndarray:
        """(m, c) of points moved by (m, k, 3) [m] and a body turned by (m, 3) [rad], both in base axes."""
        if self.cell.kind == "touch":
            return moved[:, 0] / self.made.plan.noise
        view = self.cell.views[self.cell.session][:, :3, :3]
        spun = np.zeros((self.cell.m, 3)) if spun is None else spun
        return self._seen(np.einsum("mij,mkj->mki", view, moved), np.einsum("mij,mj->mi", view, spun))

    def _seen(self, moved: np.ndarray, spun: np.ndarray) -> np.ndarray:
        sigma = self.made.plan.noise
        if self.made.lengths is not None:
            point = self.read[:, 0]
            along = point / np.linalg.norm(point, axis=1, keepdims=True)
            return np.sum(along * moved[:, 0], axis=1, keepdims=True) / sigma
        parts = [moved.reshape(len(moved), -1) / sigma]
        if self.made.orientations is not None:
            parts.append(spun / ORIENTATION_SIGMA)
        return np.hstack(parts)


def _met(made: Made) -> Cell:
    """The cell at the angles that meet the targets, which without noise would have been recorded.

    At the recorded ones the gaps are noise, and lengths, tool and targets all shrunk to nothing would explain it.
    """
    cell = made.cell
    for _ in range(2):
        world = world_with(cell, made.terms)
        tip, jacobian = contact(cell, world)
        there = standing(cell, made.terms).q + newton_step(jacobian, goals(cell, world) - tip, 1e-12)
        cell = shown(cell, there, made.terms)
    return cell


def free_names(term: Term) -> list[str]:
    """Parameters of a term that are strengths."""
    return ["mass"] if term.effect == "payload" else list(term.parameters)


def _small_turn(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """(m, 3) rotation vector that takes b to a, in the axes both are given in; small turns."""
    r = a @ np.swapaxes(b, 1, 2)
    return 0.5 * np.stack([r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1]], axis=1)
