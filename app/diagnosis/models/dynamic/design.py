"""Columns of a joint log joint by joint, whitened, and their Gram matrix: what the evidence works on.

A column belongs to some joints only (dry friction to one, masses to those before the link), so it is kept joint by
joint, and so is the product of any two.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from app.diagnosis.models.dynamic.noise import SKIPPED, Whitener


class TorqueDesign:
    """y (M, n) = sum of columns + noise, every row of unit noise once whitened.

    Joints that are not `alive` measure nothing: they have no columns. `matrix`, `right`, `total`, `dof` are what
    `Evidence` asks for; columns are scaled to their nominal widths. Without whiteners columns are only gathered, until
    `whiten` says how loud the noise is.
    """

    def __init__(self, y: np.ndarray, whiteners: Sequence[Whitener] | None, alive: np.ndarray):
        self.y, self.alive = y, alive
        self.joints = y.shape[1]
        self.at: list[np.ndarray] = [np.zeros(0, int) for _ in range(self.joints)]
        self._raw = [_Growing(len(y)) for _ in range(self.joints)]
        self._white = [_Growing(len(y) - SKIPPED) for _ in range(self.joints)]
        self._grams = [np.zeros((0, 0)) for _ in range(self.joints)]
        self._stale: list[set[int]] = [set() for _ in range(self.joints)]
        self.scale = np.zeros(0)
        self.matrix, self.right, self.total, self.dof = np.zeros((0, 0)), np.zeros(0), 0.0, int(y.size)
        self._raw_grams: dict[int, np.ndarray] = {}
        self.whiteners: list[Whitener] = []
        self.white_y: list[np.ndarray] = []
        if whiteners is not None:
            self.whiten(whiteners)

    @property
    def size(self) -> int:
        """Number of columns."""
        return len(self.scale)

    @property
    def raw(self) -> list[np.ndarray]:
        """Columns (M, k) of each joint, in the order of `at`."""
        return [columns.array for columns in self._raw]

    @property
    def white(self) -> list[np.ndarray]:
        """The same, whitened."""
        return [columns.array for columns in self._white]

    def add(self, blocks: Sequence[tuple[Mapping[int, np.ndarray], np.ndarray]]) -> list[np.ndarray]:
        """Takes blocks of columns, joint -> (M, d), with nominal widths (d,); returns the numbers of each block."""
        start, numbers = self.size, []
        parts: list[list[np.ndarray]] = [[] for _ in range(self.joints)]
        at: list[list[np.ndarray]] = [[] for _ in range(self.joints)]
        for columns, widths in blocks:
            own = np.arange(start, start + len(widths))
            numbers.append(own)
            start += len(widths)
            for joint, values in columns.items():
                if self.alive[joint]:
                    parts[joint].append(values)
                    at[joint].append(own)
        if not blocks:
            return []
        self.scale = np.concatenate([self.scale, *(w for _, w in blocks)])
        if self.whiteners:
            grown = np.zeros((start, start))
            old = len(self.matrix)
            grown[:old, :old] = self.matrix
            self.matrix, self.right = grown, np.concatenate([self.right, np.zeros(start - old)])
        for j in range(self.joints):
            if not parts[j]:
                continue
            ids = np.concatenate(at[j])
            new = self._raw[j].more(len(ids))
            for values, own, first in zip(parts[j], at[j], np.cumsum([0, *map(len, at[j])]), strict=False):
                np.multiply(values, self.scale[own], out=new[:, first : first + len(own)])
            if self.whiteners:
                self._enter(j, new, ids)
            self.at[j] = np.concatenate([self.at[j], ids])
        return numbers

    def _enter(self, j: int, new: np.ndarray, ids: np.ndarray) -> None:
        """Takes new columns of a joint into the products."""
        white = self.whiteners[j](new)
        cross, block = self._white[j].array.T @ white, white.T @ white
        self.matrix[np.ix_(self.at[j], ids)] += cross
        self.matrix[np.ix_(ids, self.at[j])] += cross.T
        self.matrix[np.ix_(ids, ids)] += block
        self._grams[j] = np.block([[self._grams[j], cross], [cross.T, block]])
        self.right[ids] += white.T @ self.white_y[j]
        self._white[j].more(len(ids))[:] = white

    def replace(self, number: int, columns: Mapping[int, np.ndarray]) -> None:
        """Puts other values (M,) in the place of a column; the Gram matrix waits for `whiten`."""
        for joint, values in columns.items():
            if not self.alive[joint]:
                continue
            place = int(np.flatnonzero(self.at[joint] == number)[0])
            self._raw[joint].array[:, place] = values * self.scale[number]
            self._stale[joint].add(place)

    def whiten(self, whiteners: Sequence[Whitener], y: np.ndarray | None = None) -> None:
        """Everything anew under other noise, and other measured torques where spikes were drawn in."""
        if y is not None:
            self.y = y
        old, self.whiteners = self.whiteners, list(whiteners)
        self.white_y = [w(self.y[:, j]) for j, w in enumerate(self.whiteners)]
        self.matrix, self.right, self.total = np.zeros((self.size, self.size)), np.zeros(self.size), 0.0
        for j, (ids, own) in enumerate(zip(self.at, self.white_y, strict=True)):
            self._whitened(j, old[j] if old else None)
            self.matrix[np.ix_(ids, ids)] += self._grams[j]
            self.right[ids] += self._white[j].array.T @ own
            self.total += float(own @ own)
        self._raw_grams.clear()

    def raw_gram(self, j: int) -> np.ndarray:
        """(k, k) products of a joint's columns as they are, kept until they are whitened."""
        if j not in self._raw_grams:
            self._raw_grams[j] = self._raw[j].array.T @ self._raw[j].array
        return self._raw_grams[j]

    def _whitened(self, j: int, old: Whitener | None) -> None:
        """Columns and Gram matrix of a joint under its new noise: of the same shape, only its loudness counts."""
        new, raw = self.whiteners[j], self._raw[j].array
        stale = np.array(sorted(self._stale[j]), int)
        self._stale[j] = set()
        if old is None or (new.rho, new.theta) != (old.rho, old.theta):
            self._white[j].adopt(new(raw))
            if new.rho == new.theta and j in self._raw_grams:
                self._grams[j] = (self._raw_grams[j] - raw[:SKIPPED].T @ raw[:SKIPPED]) / new.sigma**2
            else:
                self._grams[j] = self._white[j].array.T @ self._white[j].array
            return
        white = self._white[j].array
        if new.sigma != old.sigma:
            white *= old.sigma / new.sigma
            self._grams[j] *= (old.sigma / new.sigma) ** 2
        if len(stale):
            white[:, stale] = new(raw[:, stale])
            cross = white.T @ white[:, stale]
            self._grams[j][:, stale], self._grams[j][stale] = cross, cross.T

    def prediction(self, columns: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """(M, n) torque of some columns with weights in nominal widths [Nm]."""
        full = np.zeros(self.size)
        np.add.at(full, columns, weights)
        return np.stack([raw @ full[ids] for raw, ids in zip(self.raw, self.at, strict=True)], axis=1)

    def residual(self, columns: np.ndarray, weights: np.ndarray) -> list[np.ndarray]:
        """Whitened residual of each joint."""
        full = np.zeros(self.size)
        np.add.at(full, columns, weights)
        return [
            own - white @ full[ids] for own, white, ids in zip(self.white_y, self.white, self.at, strict=True)
        ]

    def counts(self, columns: np.ndarray) -> np.ndarray:
        """(n,) how many parameters each joint's torque serves to fit; one that several joints share is shared out."""
        chosen = set(np.asarray(columns, int).tolist())
        shared: dict[int, int] = {}
        for ids in self.at:
            for k in ids.tolist():
                shared[k] = shared.get(k, 0) + 1
        return np.array([sum(1.0 / shared[k] for k in ids.tolist() if k in chosen) for ids in self.at])


class _Growing:
    """Columns (rows, k), more of which come again and again, without a copy of all each time."""

    def __init__(self, rows: int):
        self._room = np.empty((rows, 0), order="F")
        self.array = self._room

    def more(self, columns: int) -> np.ndarray:
        """(rows, columns) further ones, to be filled."""
        first = self.array.shape[1]
        count = first + columns
        if count > self._room.shape[1]:
            room = np.empty((len(self._room), max(count, 5 * first // 4)), order="F")
            room[:, :first] = self.array
            self._room = room
        self.array = self._room[:, :count]
        return self._room[:, first:count]

    def adopt(self, columns: np.ndarray) -> None:
        """Other columns in the place of all."""
        self._room = self.array = columns
