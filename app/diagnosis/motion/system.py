"""Everything the search needs of a log, reduced block by block to Gram matrices.

Per joint j the whitened columns C_j = [y | inertial | shared | its own laws | its own curves], their Gram matrix,
and block by block that of the columns in use. Selection, nulls, held-out errors and window scans are then
small algebra, whatever the length of the log.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from app.diagnosis.effects.motion._law import Law, Values, Where
from app.diagnosis.motion.joint_system import ROOM, JointSystem
from app.diagnosis.motion.sampling import Samples
from app.diagnosis.motion.whitening import Whitener
from app.kinematics.dynamics import PER_LINK

FEW = 16  # columns whitened at a time: what is made on the way stays near the processor
REMEMBERED = 64  # models whose solution is kept: the same ones are asked for again and again


@dataclass(frozen=True, eq=False)
class Group:
    """Columns that come and go together.

    Args:
        law: the effect, or None for a curve.
        where, shape: its place.
        joint: index from 0, or None where it reaches all joints.
        size: number of columns.
        base: True for columns that only windows are cut from.
        bent: True where columns for small steps of the shape follow the linear ones.
    """

    law: Law | None
    where: Where
    shape: Values
    joint: int | None
    size: int
    base: bool = False
    bent: bool = False
    name: str = ""

    @property
    def label(self) -> str:
        return self.law.key if self.law is not None else f"curve of {self.name}"

    @cached_property
    def key(self) -> tuple:
        """A law at a place counts once, whatever its shape; a ripple's order is its place."""
        ripple = self.law is not None and self.law.key == "torque_ripple"
        shape = tuple(sorted(self.shape.items())) if ripple else ()
        return (self.label, tuple(sorted((k, str(v)) for k, v in self.where.items())), shape)


class System:
    """All joints' columns of one log under one whitening."""

    def __init__(
        self,
        samples: Samples,
        whiteners: list[Whitener],
        shared: list[tuple[Group, np.ndarray]],
        local: list[list[tuple[Group, np.ndarray]]],
    ):
        """Args:
        shared: groups with pooled columns (M, n, k).
        local: per joint, groups with pooled columns (M, k).
        """
        self.samples, self.whiteners = samples, whiteners
        self.joints = samples.y.shape[1]
        self.edges = np.searchsorted(samples.blocks, np.arange(samples.block_count + 1))
        self.parts: list[JointSystem] = []
        for j in range(self.joints):
            here = [*((g, v[:, j]) for g, v in shared), *local[j]]
            self.parts.append(self._part(j, here))
        self.groups = [g for g, _ in shared] + [g for part in local for g, _ in part]
        #: Columns before whitening.
        self.raw: dict[Group, np.ndarray] = dict(shared) | {g: v for part in local for g, v in part}
        self._inertial = np.zeros((self.inertial_size,) * 2)
        for j, part in enumerate(self.parts):
            at = slice(1, 1 + part.inertial)
            self._inertial[PER_LINK * j :, PER_LINK * j :] += part.total[at, at]
        self._inertial_folds: dict[bytes, np.ndarray] = {}
        self._layouts: dict[tuple[Group, ...], tuple[list[np.ndarray], list[np.ndarray], int]] = {}
        #: What was solved for, by the model; forgotten when the columns change.
        self.solutions: dict[tuple, Any] = {}

    def _part(self, j: int, groups: list[tuple[Group, np.ndarray]]) -> JointSystem:
        inertial = self.samples.regressor[:, PER_LINK * j :, j]
        size = 1 + inertial.shape[1] + sum(g.size for g, _ in groups)
        rows = np.empty((size + ROOM, len(inertial)))
        rows[0], rows[1 : 1 + inertial.shape[1]] = self.samples.y[:, j], inertial.T
        places: dict[Group, slice] = {}
        at = 1 + inertial.shape[1]
        for group, values in groups:
            places[group] = slice(at, at + group.size)
            rows[places[group]] = values.T
            at += group.size
        for some in range(0, size, FEW):
            part = slice(some, min(some + FEW, size))
            rows[part] = self.whiteners[j](rows[part].T).T
        part = JointSystem(rows, size, inertial.shape[1], places, self.edges)
        for group, place in places.items():
            if group.base:
                part.activate(np.arange(place.start, place.stop))
        return part

    @property
    def block_count(self) -> int:
        return self.samples.block_count

    @property
    def inertial_size(self) -> int:
        return PER_LINK * self.joints

    def append(self, group: Group, values: np.ndarray) -> Group:
        """Adds columns: (M, k) for a joint, (M, n, k) shared; gives the group back."""
        for j, part in enumerate(self.parts):
            if group.joint is None or group.joint == j:
                part.append(group, self.whiteners[j](values if group.joint is not None else values[:, j]))
        self.groups.append(group)
        self.raw[group] = values
        return group

    def remove(self, group: Group) -> None:
        """Forgets a group that was only tried, where nothing came in after it."""
        here = [p for p in self.parts if group in p.places]
        if group in self.raw and all(p.places[group].stop == p.size for p in here):
            for part in here:
                part.remove_last(group)
            self.groups.remove(group)
            del self.raw[group]
            self._layouts = {k: v for k, v in self._layouts.items() if group not in k}
            self.solutions = {k: v for k, v in self.solutions.items() if group not in k}

    def replace_response(self, values: np.ndarray) -> None:
        """Puts another y in: (M, n), torque beyond the description and beyond what was linearised away."""
        for j, part in enumerate(self.parts):
            part.replace_response(self.whiteners[j](values[:, j]))
        self.solutions.clear()

    def layout(self, selected: list[Group]) -> tuple[list[np.ndarray], list[np.ndarray], int]:
        """Where the unknowns of a model stand; inertial ones first.

        Returns:
            per joint the columns in use, per joint their positions among the unknowns, number of unknowns.
        """
        key = tuple(selected)
        if key in self._layouts:
            return self._layouts[key]
        columns = [[np.arange(1, 1 + part.inertial)] for part in self.parts]
        positions = [[np.arange(self.inertial_size - p.inertial, self.inertial_size)] for p in self.parts]
        at = self.inertial_size
        for group in selected:
            here = range(self.joints) if group.joint is None else (group.joint,)
            for j in here:
                place = self.parts[j].places[group]
                columns[j].append(np.arange(place.start, place.stop))
                positions[j].append(np.arange(at, at + group.size))
            at += group.size
        found = [np.concatenate(c) for c in columns], [np.concatenate(p) for p in positions], at
        if len(self._layouts) >= REMEMBERED:
            del self._layouts[next(iter(self._layouts))]
        self._layouts[key] = found
        return found

    def normal(self, selected: list[Group]) -> tuple[np.ndarray, np.ndarray, float]:
        """Normal matrix (p, p), right-hand side (p,) and y^T y over all blocks."""
        columns, positions, size = self.layout(selected)
        i = self.inertial_size
        A, g, yy = np.zeros((size, size)), np.zeros(size), 0.0
        A[:i, :i] = self._inertial
        for part, col, pos in zip(self.parts, columns, positions, strict=True):
            links = slice(i - part.inertial, i)
            more, to = col[part.inertial :], pos[part.inertial :]
            rows = part.total[more]
            A[to, links] += rows[:, 1 : 1 + part.inertial]
            A[to[:, None], to] += rows[:, more]
            g[links] += part.total[0, 1 : 1 + part.inertial]
            g[to] += rows[:, 0]
            yy += part.total[0, 0]
        A[:i, i:] = A[i:, :i].T
        return A, g, float(yy)

    def normal_folds(
        self, selected: list[Group], chosen: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The same over each fold: (f, p, p), (f, p) and (f,); chosen (f, B) says which blocks a fold has."""
        columns, positions, size = self.layout(selected)
        count, i = len(chosen), self.inertial_size
        A, g, yy = np.zeros((count, size, size)), np.zeros((count, size)), np.zeros(count)
        A[:, :i, :i] = self._inertial_over(chosen)
        for part, col, pos in zip(self.parts, columns, positions, strict=True):
            links = slice(i - part.inertial, i)
            slots, to = part.activate(col[part.inertial :]), pos[part.inertial :]
            summed = part.folds(chosen)
            rows = summed[:, slots]
            A[:, to, links] += rows[:, :, 1 : 1 + part.inertial]
            A[:, to[:, None], to] += rows[:, :, slots]
            g[:, links] += summed[:, 0, 1 : 1 + part.inertial]
            g[:, to] += rows[:, :, 0]
            yy += summed[:, 0, 0]
        A[:, :i, i:] = np.swapaxes(A[:, i:, :i], 1, 2)
        return A, g, yy

    def _inertial_over(self, chosen: np.ndarray) -> np.ndarray:
        """(f, i, i) of the inertial columns over each fold."""
        key = chosen.tobytes()
        if key not in self._inertial_folds:
            out = np.zeros((len(chosen), *self._inertial.shape))
            for j, part in enumerate(self.parts):
                at = slice(1, 1 + part.inertial)
                out[:, PER_LINK * j :, PER_LINK * j :] += part.folds(chosen)[:, at, at]
            self._inertial_folds[key] = out
        return self._inertial_folds[key]

    def residuals(
        self, theta: np.ndarray, columns: list[np.ndarray], positions: list[np.ndarray]
    ) -> list[np.ndarray]:
        """Per joint (M,): whitened y less what a model explains."""
        return [
            part.residual(col, theta[pos])
            for part, col, pos in zip(self.parts, columns, positions, strict=True)
        ]

    def block_scores(self, theta: np.ndarray, columns: list[np.ndarray], positions: list[np.ndarray]):
        """Per joint (B, P): columns^T residual, block by block."""
        left = self.residuals(theta, columns, positions)
        return [part.block_scores(residual) for part, residual in zip(self.parts, left, strict=True)]

    @property
    def rows(self) -> int:
        """Rows that count, over all joints."""
        return int(sum(np.count_nonzero(w.weight) for w in self.whiteners))


def windowed(group: Group, **times: float) -> Group:
    """The same group between two times."""
    return replace(group, where={**group.where, **times}, base=False)
