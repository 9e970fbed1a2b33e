"""Everything the search needs of a log, reduced block by block to Gram matrices.

Per joint j the whitened columns C_j = [y | inertial | shared | its own laws | its own curves], their Gram matrix,
and block by block that of the columns in use. Selection, nulls, held-out errors and window scans are then
small algebra, whatever the length of the log.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from app.diagnosis.effects.motion._law import Law, Values, Where
from app.diagnosis.motion.sampling import Samples
from app.diagnosis.motion.whitening import Whitener
from app.kinematics.dynamics import PER_LINK

ROOM = 64  # columns that may come in before memory is moved


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


class JointSystem:
    """One joint's whitened columns.

    Column 0 is y, then the inertial columns of links j.., then groups. Of all columns the Gram matrix is kept,
    of those in use also block by block.
    """

    def __init__(self, columns: np.ndarray, size: int, places: dict[Group, slice], edges: np.ndarray):
        """Args:
        columns: (M, P + room) whitened; the last are room for more.
        size: P.
        places: group -> its columns.
        edges: (B + 1,) where the blocks begin.
        """
        self.places, self.edges, self.size, self._columns = places, edges, size, columns
        self._total = np.zeros((columns.shape[1],) * 2)
        self._total[:size, :size] = self.columns.T @ self.columns
        self._slot = np.full(columns.shape[1], -1)
        self._active = np.zeros(0, int)
        #: (B, a, a) Gram matrices of the active columns; `activate` says where a column stands in them.
        self.blocks = np.zeros((len(edges) - 1, 0, 0))
        self._folds: dict[bytes, np.ndarray] = {}

    @property
    def columns(self) -> np.ndarray:
        """(M, P)."""
        return self._columns[:, : self.size]

    @property
    def total(self) -> np.ndarray:
        """(P, P) columns^T columns."""
        return self._total[: self.size, : self.size]

    def activate(self, wanted: np.ndarray) -> np.ndarray:
        """Slots of columns in `blocks`, computed for those not there yet."""
        slots = self._slot[wanted]
        if slots.min(initial=0) >= 0:
            return slots
        new, old = wanted[slots < 0], len(self._active)
        self._active = np.concatenate([self._active, new])
        self._slot[new] = np.arange(old, len(self._active))
        grown = np.zeros((len(self.blocks), len(self._active), len(self._active)))
        grown[:, :old, :old] = self.blocks
        every, fresh = self._columns[:, self._active], self._columns[:, new]
        for b, rows in enumerate(self.block_rows()):
            cross = fresh[rows].T @ every[rows]
            grown[b, old:, :] = cross
            grown[b, :, old:] = cross.T
        self.blocks = grown
        self._folds.clear()
        return self._slot[wanted]

    def folds(self, chosen: np.ndarray) -> np.ndarray:
        """(f, a, a) sums of `blocks` over folds; chosen (f, B) is 1 where a block belongs to a fold."""
        key = chosen.tobytes()
        if key not in self._folds:
            flat = chosen.astype(float) @ self.blocks.reshape(len(self.blocks), -1)
            self._folds[key] = flat.reshape(len(chosen), *self.blocks.shape[1:])
        return self._folds[key]

    def block_rows(self) -> list[slice]:
        return [slice(a, b) for a, b in pairwise(self.edges.tolist())]

    def append(self, group: Group, fresh: np.ndarray) -> None:
        """One more group, its columns whitened (M, k)."""
        old, new = self.size, self.size + fresh.shape[1]
        if new > self._columns.shape[1]:
            room = new + ROOM
            columns, total = np.empty((len(fresh), room)), np.zeros((room, room))
            columns[:, :old], total[:old, :old] = self.columns, self.total
            self._columns, self._total = columns, total
            self._slot = np.concatenate([self._slot, np.full(room - len(self._slot), -1)])
        self._columns[:, old:new] = fresh
        self.size = new
        cross = fresh.T @ self.columns
        self._total[old:new, :new], self._total[:new, old:new] = cross, cross.T
        self.places[group] = slice(old, new)

    def remove_last(self, group: Group) -> None:
        """Forgets the group that came in last."""
        place = self.places.pop(group)
        self.size = place.start
        kept = self._active < place.start
        if not kept.all():
            self._active = self._active[kept]
            self.blocks = self.blocks[:, kept][:, :, kept]
            self._folds.clear()
        self._slot[:] = -1
        self._slot[self._active] = np.arange(len(self._active))

    def replace_response(self, values: np.ndarray) -> None:
        """Puts another whitened y (M,) in."""
        self._columns[:, 0] = values
        self._total[0, : self.size] = self._total[: self.size, 0] = values @ self.columns
        if not len(self._active):
            return
        active = self._columns[:, self._active]
        at = int(self._slot[0])
        for b, rows in enumerate(self.block_rows()):
            self.blocks[b, at] = self.blocks[b, :, at] = values[rows] @ active[rows]
        self._folds.clear()


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
            always = [np.arange(at)]
            for group, values in [*((g, v[:, j]) for g, v in shared), *local[j]]:
                pieces.append(values)
                places[group] = slice(at, at + group.size)
                if group.base:
                    always.append(np.arange(at, at + group.size))
                at += group.size
            pieces.append(np.zeros((len(inertial), ROOM)))
            part = JointSystem(whiteners[j](np.concatenate(pieces, axis=1)), at, places, self.edges)
            part.activate(np.concatenate(always))
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

    def replace_response(self, values: np.ndarray) -> None:
        """Puts another y in: (M, n), torque beyond the description and beyond what was linearised away."""
        for j, part in enumerate(self.parts):
            part.replace_response(self.whiteners[j](values[:, j]))

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

    def normal(self, selected: list[Group]) -> tuple[np.ndarray, np.ndarray, float]:
        """Normal matrix (p, p), right-hand side (p,) and y^T y over all blocks."""
        columns, positions, size = self.layout(selected)
        A, g, yy = np.zeros((size, size)), np.zeros(size), 0.0
        for part, col, pos in zip(self.parts, columns, positions, strict=True):
            A[pos[:, None], pos] += part.total[col[:, None], col]
            g[pos] += part.total[col, 0]
            yy += part.total[0, 0]
        return A, g, float(yy)

    def normal_folds(
        self, selected: list[Group], chosen: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The same over each fold: (f, p, p), (f, p) and (f,); chosen (f, B) says which blocks a fold has."""
        columns, positions, size = self.layout(selected)
        count = len(chosen)
        A, g, yy = np.zeros((count, size, size)), np.zeros((count, size)), np.zeros(count)
        for part, col, pos in zip(self.parts, columns, positions, strict=True):
            slots, first = part.activate(col), int(part.activate(np.zeros(1, int))[0])
            summed = part.folds(chosen)
            A[:, pos[:, None], pos] += summed[:, slots[:, None], slots]
            g[:, pos] += summed[:, slots, first]
            yy += summed[:, first, first]
        return A, g, yy

    def block_scores(self, theta: np.ndarray, columns: list[np.ndarray], positions: list[np.ndarray]):
        """Per joint (B, P): columns^T residual, block by block."""
        out = []
        for part, col, pos in zip(self.parts, columns, positions, strict=True):
            residual = part.columns[:, 0] - part.columns[:, col] @ theta[pos]
            out.append(np.array([residual[rows] @ part.columns[rows] for rows in part.block_rows()]))
        return out

    @property
    def rows(self) -> int:
        """Rows that count, over all joints."""
        return int(sum(np.count_nonzero(w.weight) for w in self.whiteners))


def windowed(group: Group, **times: float) -> Group:
    """The same group between two times."""
    return replace(group, where={**group.where, **times}, base=False)
