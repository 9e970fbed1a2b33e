"""One joint's whitened columns and their Gram matrices.

Every column lies next to itself in memory, so that some of them are picked by copying whole stretches.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from app.diagnosis.motion.system import Group

ROOM = 64  # columns that may come in before memory is moved
SLOTS = 12  # likewise into use


class JointSystem:
    """Column 0 is y, then the inertial columns of links j.., then groups.

    Of all columns the Gram matrix is kept, of those in use also block by block. y and the inertial columns are
    always in use, and stand first there too.
    """

    def __init__(
        self,
        rows: np.ndarray,
        size: int,
        inertial: int,
        places: dict[Group, slice],
        edges: np.ndarray,
    ):
        """Args:
        rows: (P + room, M) whitened columns; the last are room for more.
        size: P.
        inertial: number of inertial columns.
        places: group -> its columns.
        edges: (B + 1,) where the blocks begin.
        """
        self.places, self.edges, self.size, self.inertial = places, edges, size, inertial
        self._rows = rows
        self._total = np.zeros((len(rows),) * 2)
        self._total[:size, :size] = rows[:size] @ rows[:size].T
        self._slot = np.full(len(rows), -1)
        self._active = np.zeros(0, int)
        self._blocks = np.zeros((len(edges) - 1, 0, 0))
        self._folds: dict[bytes, tuple[np.ndarray, np.ndarray]] = {}
        self.activate(np.arange(1 + inertial))

    @property
    def columns(self) -> np.ndarray:
        """(M, P)."""
        return self._rows[: self.size].T

    @property
    def total(self) -> np.ndarray:
        """(P, P) columns^T columns."""
        return self._total[: self.size, : self.size]

    @property
    def blocks(self) -> np.ndarray:
        """(B, a, a) Gram matrices of the columns in use; `activate` says where a column stands in them."""
        used = len(self._active)
        return self._blocks[:, :used, :used]

    def residual(self, wanted: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(M,) y less `values` times the columns `wanted`, of which the inertial ones stand first."""
        i = self.inertial
        left = self._rows[0] - values[:i] @ self._rows[1 : 1 + i]
        return left - values[i:] @ self._rows[wanted[i:]] if len(wanted) > i else left

    def scores(self, wanted: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(P,) columns^T of the same residual, from the Gram matrix."""
        i, total = self.inertial, self.total
        left = total[0] - values[:i] @ total[1 : 1 + i]
        return left - values[i:] @ total[wanted[i:]] if len(wanted) > i else left

    def products(self, fresh: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        """(k, a) fresh (M, k) against the columns `wanted`, of which the inertial ones stand first."""
        i = self.inertial
        return np.concatenate([(self._rows[1 : 1 + i] @ fresh).T, (self._rows[wanted[i:]] @ fresh).T], axis=1)

    def block_scores(self, residual: np.ndarray) -> np.ndarray:
        """(B, P) columns^T residual (M,), block by block."""
        return np.array([self._rows[: self.size, rows] @ residual[rows] for rows in self.block_rows()])

    def block_rows(self) -> list[slice]:
        return [slice(a, b) for a, b in pairwise(self.edges.tolist())]

    def activate(self, wanted: np.ndarray) -> np.ndarray:
        """Slots of columns in `blocks`, computed for those not there yet."""
        slots = self._slot[wanted]
        if slots.min(initial=0) >= 0:
            return slots
        new, old = wanted[slots < 0], len(self._active)
        self._active = np.concatenate([self._active, new])
        now = len(self._active)
        self._slot[new] = np.arange(old, now)
        if now > self._blocks.shape[1]:
            self._blocks = _widened(self._blocks, now + SLOTS)
            self._folds = {k: (chosen, _widened(f, now + SLOTS)) for k, (chosen, f) in self._folds.items()}
        every, fresh = self._rows[self._active], self._rows[new]
        cross = np.empty((len(self._blocks), now - old, now))
        for b, rows in enumerate(self.block_rows()):
            np.matmul(fresh[:, rows], every[:, rows].T, out=cross[b])
        _put(self._blocks, old, now, cross)
        for chosen, summed in self._folds.values():
            _put(summed, old, now, _summed(chosen, cross))
        return self._slot[wanted]

    def folds(self, chosen: np.ndarray) -> np.ndarray:
        """(f, a, a) sums of `blocks` over folds; chosen (f, B) is 1 where a block belongs to a fold."""
        key, used = chosen.tobytes(), len(self._active)
        if key not in self._folds:
            self._folds[key] = (chosen, _widened(_summed(chosen, self.blocks), self._blocks.shape[1]))
        return self._folds[key][1][:, :used, :used]

    def append(self, group: Group, fresh: np.ndarray) -> None:
        """One more group, its columns whitened (M, k)."""
        old, new = self.size, self.size + fresh.shape[1]
        if new > len(self._rows):
            room = new + ROOM
            rows, total = np.empty((room, len(fresh))), np.zeros((room, room))
            rows[:old], total[:old, :old] = self._rows[:old], self.total
            self._rows, self._total = rows, total
            self._slot = np.concatenate([self._slot, np.full(room - len(self._slot), -1)])
        self._rows[old:new] = fresh.T
        self.size = new
        cross = self._rows[old:new] @ self._rows[:new].T
        self._total[old:new, :new], self._total[:new, old:new] = cross, cross.T
        self.places[group] = slice(old, new)

    def remove_last(self, group: Group) -> None:
        """Forgets the group that came in last."""
        place = self.places.pop(group)
        self.size = place.start
        kept = np.flatnonzero(self._active < place.start)
        if len(kept) < len(self._active):
            if kept[-1] >= len(kept):  # others came into use after it
                self._blocks = self._blocks[:, kept[:, None], kept]
                self._folds.clear()
            self._active = self._active[kept]
        self._slot[:] = -1
        self._slot[self._active] = np.arange(len(self._active))

    def replace_response(self, values: np.ndarray) -> None:
        """Puts another whitened y (M,) in."""
        self._rows[0] = values
        self._total[0, : self.size] = self._total[: self.size, 0] = self._rows[: self.size] @ values
        active, used = self._rows[self._active], len(self._active)
        for b, rows in enumerate(self.block_rows()):
            self._blocks[b, 0, :used] = self._blocks[b, :used, 0] = active[:, rows] @ values[rows]
        self._folds.clear()


def _widened(matrices: np.ndarray, size: int) -> np.ndarray:
    """(f, a, a) -> (f, size, size), zeros beyond."""
    out = np.zeros((len(matrices), size, size))
    old = matrices.shape[1]
    out[:, :old, :old] = matrices
    return out


def _put(matrices: np.ndarray, old: int, now: int, cross: np.ndarray) -> None:
    """Rows and columns old to now of symmetric matrices."""
    matrices[:, old:now, :now] = cross
    matrices[:, :now, old:now] = np.swapaxes(cross, 1, 2)


def _summed(chosen: np.ndarray, blocks: np.ndarray) -> np.ndarray:
    flat = chosen.astype(float) @ blocks.reshape(len(blocks), -1)
    return flat.reshape(len(chosen), *blocks.shape[1:])
