"""Everything the search needs of a log, reduced block by block to Gram matrices.

Per joint j the whitened columns C_j = [y | inertial | shared | its own laws | its own curves], their Gram matrix,
and block by block that of the columns in use. Selection, nulls, held-out errors and window scans are then
small algebra, whatever the length of the log.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.effects.motion._law import Law, Values, Where
from app.diagnosis.motion.sampling import Samples
from app.diagnosis.motion.whitening import Whitener
from app.kinematics.dynamics import PER_LINK


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


@dataclass(eq=False)
class JointSystem:
    """One joint's whitened columns.

    Args:
        columns: (M, P); column 0 is y, then the inertial columns of links j.., then groups.
        total: (P, P) columns^T columns.
        places: group -> its columns.
        active: columns whose Gram matrices are kept block by block; `slot` says where.
        blocks: (B, a, a) Gram matrices of the active columns.
    """

    columns: np.ndarray
    total: np.ndarray
    places: dict[Group, slice]
    active: list[int]
    slot: dict[int, int]
    blocks: np.ndarray

    def activate(self, wanted: np.ndarray, edges: np.ndarray) -> np.ndarray:
        """Slots of columns in `blocks`, computed for those not there yet."""
        new = [int(c) for c in wanted if int(c) not in self.slot]
        if new:
            old = len(self.active)
            for c in new:
                self.slot[c] = len(self.active)
                self.active.append(c)
            size = len(self.active)
            grown = np.zeros((len(self.blocks), size, size))
            grown[:, :old, :old] = self.blocks
            every, fresh = self.columns[:, self.active], self.columns[:, new]
            for b in range(len(grown)):
                rows = slice(edges[b], edges[b + 1])
                cross = fresh[rows].T @ every[rows]
                grown[b, old:, :] = cross
                grown[b, :, old:] = cross.T
            self.blocks = grown
        return np.array([self.slot[int(c)] for c in wanted], int)


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
            inertial = samples.regressor[:, PER_LINK * j :, j]
            pieces = [samples.y[:, j, None], inertial]
            places: dict[Group, slice] = {}
            at = 1 + inertial.shape[1]
            for group, values in [*((g, v[:, j]) for g, v in shared), *local[j]]:
                pieces.append(values)
                places[group] = slice(at, at + group.size)
                at += group.size
            columns = whiteners[j](np.concatenate(pieces, axis=1))
            first = list(range(1 + inertial.shape[1]))
            part = JointSystem(
                columns, columns.T @ columns, places, [], {}, np.zeros((samples.block_count, 0, 0))
            )
            part.activate(np.array(first), self.edges)
            self.parts.append(part)
        self.groups = [g for g, _ in shared] + [g for part in local for g, _ in part]
        #: Columns before whitening.
        self.raw: dict[Group, np.ndarray] = dict(shared) | {g: v for part in local for g, v in part}

    @property
    def block_count(self) -> int:
        return self.samples.block_count

    @property
    def inertial_size(self) -> int:
        return PER_LINK * self.joints

    def append(self, group: Group, values: np.ndarray) -> Group:
        """Adds columns: (M, k) for a joint, (M, n, k) shared; gives the group back."""
        for j, part in enumerate(self.parts):
            if group.joint is not None and group.joint != j:
                continue
            fresh = self.whiteners[j](values if group.joint is not None else values[:, j])
            old = part.columns.shape[1]
            part.columns = np.concatenate([part.columns, fresh], axis=1)
            cross = fresh.T @ part.columns
            total = np.zeros((part.columns.shape[1],) * 2)
            total[:old, :old] = part.total
            total[old:, :], total[:, old:] = cross, cross.T
            part.total = total
            part.places[group] = slice(old, old + group.size)
        self.groups.append(group)
        self.raw[group] = values
        return group

    def replace_response(self, values: np.ndarray) -> None:
        """Puts another y in: (M, n), torque beyond the description and beyond what was linearised away."""
        for j, part in enumerate(self.parts):
            part.columns[:, 0] = self.whiteners[j](values[:, j])
            part.total[0] = part.total[:, 0] = part.columns[:, 0] @ part.columns
            active = part.columns[:, part.active]
            for b in range(self.block_count):
                rows = slice(self.edges[b], self.edges[b + 1])
                part.blocks[b, 0] = part.blocks[b, :, 0] = active[rows, 0] @ active[rows]

    def layout(self, selected: list[Group]) -> tuple[list[np.ndarray], list[np.ndarray], int]:
        """Where the unknowns of a model stand.

        Returns:
            per joint the columns in use, per joint their positions among the unknowns, number of unknowns.
        """
        columns, positions = [], []
        for j, part in enumerate(self.parts):
            inertial = PER_LINK * (self.joints - j)
            col = [np.arange(1, 1 + inertial)]
            pos = [np.arange(PER_LINK * j, self.inertial_size)]
            at = self.inertial_size
            for group in selected:
                if group.joint is None or group.joint == j:
                    place = part.places[group]
                    col.append(np.arange(place.start, place.stop))
                    pos.append(np.arange(at, at + group.size))
                at += group.size
            columns.append(np.concatenate(col))
            positions.append(np.concatenate(pos))
        size = self.inertial_size + sum(g.size for g in selected)
        return columns, positions, size

    def normal(
        self, selected: list[Group], blocks: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray, float]:
        """Normal matrix (p, p), right-hand side (p,) and y^T y over all blocks, or those given."""
        columns, positions, size = self.layout(selected)
        A, g, yy = np.zeros((size, size)), np.zeros(size), 0.0
        for part, col, pos in zip(self.parts, columns, positions, strict=True):
            if blocks is None:
                A[np.ix_(pos, pos)] += part.total[np.ix_(col, col)]
                g[pos] += part.total[col, 0]
                yy += part.total[0, 0]
            else:
                slots = part.activate(col, self.edges)
                summed = part.blocks[blocks].sum(0)
                A[np.ix_(pos, pos)] += summed[np.ix_(slots, slots)]
                g[pos] += summed[slots, 0]
                yy += summed[0, 0]
        return A, g, float(yy)

    def block_scores(self, theta: np.ndarray, columns: list[np.ndarray], positions: list[np.ndarray]):
        """Per joint (B, P): columns^T residual, block by block."""
        out = []
        for part, col, pos in zip(self.parts, columns, positions, strict=True):
            residual = part.columns[:, 0] - part.columns[:, col] @ theta[pos]
            scores = np.empty((self.block_count, part.columns.shape[1]))
            for b in range(self.block_count):
                rows = slice(self.edges[b], self.edges[b + 1])
                scores[b] = residual[rows] @ part.columns[rows]
            out.append(scores)
        return out

    @property
    def rows(self) -> int:
        """Rows that count, over all joints."""
        return int(sum(np.count_nonzero(w.weight) for w in self.whiteners))


def windowed(group: Group, **times: float) -> Group:
    """The same group between two times."""
    return replace(group, where={**group.where, **times}, base=False)
