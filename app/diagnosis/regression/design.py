"""Whitened columns with everything free projected off, and their Gram matrix."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np

#: Relative size of a pivot below which a free column adds nothing to those before it.
_DEPENDENT = 1e-7
#: Share of a column's square that is rounding once everything free is projected off.
_ROUNDING = 1e-13


@dataclass(frozen=True, eq=False)
class Absorbed:
    """Free parameters of which each row of the problem has exactly one (touched points, offsets of a session).

    They are projected off by group means, in time linear in the rows.

    Args:
        label: (N,) number of the parameter.
        entry: (N,) its whitened column entry.
    """

    label: np.ndarray
    entry: np.ndarray

    @cached_property
    def _groups(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Order of the rows by label, where each label starts there, its number in each row, and its norm."""
        order = np.argsort(self.label, kind="stable")
        starts = np.flatnonzero(np.r_[True, np.diff(self.label[order]) != 0])
        which = np.zeros(len(self.label), int)
        which[order] = np.repeat(np.arange(len(starts)), np.diff(np.r_[starts, len(order)]))
        norm = np.sqrt(np.maximum(np.add.reduceat(self.entry[order] ** 2, starts), 1e-300))
        return order, starts, which, norm

    def sums(self, matrix: np.ndarray) -> np.ndarray:
        """(labels, p): matrix (N, p) times the parameters' columns brought to unit length."""
        order, starts, _, norm = self._groups
        return np.add.reduceat((matrix * self.entry[:, None])[order], starts, axis=0) / norm[:, None]

    def off(self, matrix: np.ndarray) -> np.ndarray:
        """matrix (N, p) with these parameters projected off."""
        _, _, which, norm = self._groups
        return matrix - (self.sums(matrix) / norm[:, None])[which] * self.entry[:, None]

    def spread(self, sums: np.ndarray, rows: slice) -> np.ndarray:
        """Sums (labels, p) given back to rows."""
        _, _, which, norm = self._groups
        return (self.entry[rows] / norm[which[rows]])[:, None] * sums[which[rows]]

    @property
    def count(self) -> int:
        return len(self._groups[1])


class Design:
    """The problem y = X w + F f + noise, F projected off.

    y (N,) and X (N, p) are whitened: their noise has about unit variance. `matrix`, `right` and `total` are X'X,
    X'y and y'y after the projection. X itself is kept as it was given: with Q a basis of F, X'X - (Q'X)'(Q'X) is
    the Gram matrix of what is left of it, and one product more projects whatever rows are asked for.

    Args:
        response: (N,).
        free: (N, f) columns without a prior.
        absorbed: further free parameters by groups of rows.
        used: number of measured values among the N (entries of weight zero do not count).

    Attributes:
        raw: (N, p) columns as they were given, times `unit`.
        length: (p,) sum of squares of each, nothing projected off.
    """

    def __init__(self, response: np.ndarray, free: np.ndarray, used: int, absorbed: Absorbed | None = None):
        self.absorbed = absorbed
        kept = free if absorbed is None else absorbed.off(free)
        self.basis = _orthonormal(kept)
        self.free_count = self.basis.shape[1] + (0 if absorbed is None else absorbed.count)
        self.dof = max(used - self.free_count, 1)
        self.moves: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
        self._room = np.empty((len(response), 0), order="F")
        self.raw = self._room
        self.length = np.zeros(0)
        self.unit = 1.0
        self._gram, self._taken = np.zeros((0, 0)), np.zeros((0, 0))
        self._state(response)

    def _state(self, response: np.ndarray) -> None:
        self.response = self.projected(response[:, None])[:, 0]
        self.total = float(self.response @ self.response)
        self.matrix = self._gram * self.unit**2
        self.right = self.unit * (self.raw.T @ self.response)

    def restated(self, response: np.ndarray, unit: float) -> Design:
        """The same columns, times `unit`, with another response; marginality starts anew."""
        out = copy(self)
        out.moves, out.unit = [], unit
        self._room = self.raw  # only one of the two may write behind its columns
        out._state(response)
        return out

    def projected(self, matrix: np.ndarray) -> np.ndarray:
        """Rows (N, ...) with everything free projected off."""
        if self.absorbed is not None:
            matrix = self.absorbed.off(matrix)
        return matrix - self.basis @ (self.basis.T @ matrix)

    @property
    def size(self) -> int:
        """Number of columns."""
        return self.raw.shape[1]

    def room(self, count: int, more: int = 0) -> np.ndarray:
        """(N, count) to be filled with further columns, in the units of `raw`, and then taken by `fill`.

        Args:
            more: columns that are likely to follow: of many rows a copy of all is hundreds of megabytes.
        """
        start = self.size
        if start + count > self._room.shape[1]:
            room = np.empty((len(self.response), start + count + max(more, start // 4)), order="F")
            room[:, :start] = self.raw
            self._room, self.raw = room, room[:, :start]
        return self._room[:, start : start + count]

    def add(self, columns: np.ndarray) -> np.ndarray:
        """Takes further columns (N, d), whitened as the response is, and returns their numbers."""
        self.room(columns.shape[1])[:] = columns if self.unit == 1.0 else columns / self.unit
        return self.fill(columns.shape[1])

    def fill(self, count: int) -> np.ndarray:
        """Takes so many columns that were written into `room`, and returns their numbers."""
        start = self.size
        columns = self._room[:, start : start + count]
        taken = self.basis.T @ columns
        if self.absorbed is not None:
            taken = np.concatenate([taken, self.absorbed.sums(columns)])
        gram = np.empty((start + count, start + count))
        gram[:start, :start] = self._gram
        block = columns.T @ columns
        raw = np.diag(block).copy()
        gram[start:, start:] = block - taken.T @ taken
        if start:
            gram[:start, start:] = self.raw.T @ columns - self._taken.T @ taken
            gram[start:, :start] = gram[:start, start:].T
        gone = start + np.flatnonzero(np.diag(gram)[start:] <= _ROUNDING * raw)
        gram[gone], gram[:, gone] = 0.0, 0.0  # what the free columns take all of is rounding
        numbers = np.arange(start, start + count)
        self._gram = gram
        self._taken = taken if not start else np.concatenate([self._taken, taken], axis=1)
        self.raw, self.length = self._room[:, : start + count], np.append(self.length, raw)
        self._grown(numbers)
        return numbers

    def _grown(self, numbers: np.ndarray) -> None:
        """Matrix and right-hand side with further columns, what was made marginal left as it is."""
        start = len(self.right)  # the new ones are the last
        cross = self.unit**2 * self._gram[:, numbers]
        for lower, upper, taken in self.moves:
            cross[upper] -= taken.T @ cross[lower]
        matrix = np.empty((self.size, self.size))
        matrix[:start, :start] = self.matrix
        matrix[:, start:], matrix[start:, :start] = cross, cross[:start].T
        self.matrix = matrix
        self.right = np.append(self.right, self.unit * (self.raw[:, start:].T @ self.response))

    def leave_to(self, lower: np.ndarray, upper: np.ndarray, ridge: float) -> None:
        """Marginality: columns `upper` keep only what columns `lower` cannot take.

        With B what they take, a weight w of an upper column now stands for w of the old one together with -B w of
        the lower ones: see `expanded`.

        Args:
            ridge: added to the diagonal of the lower columns' Gram matrix.
        """
        gram = self.matrix[np.ix_(lower, lower)] + ridge * np.eye(len(lower))
        taken = np.linalg.solve(gram, self.matrix[np.ix_(lower, upper)])
        self.moves.append((lower, upper, taken))
        self.matrix, self.right = self.matrix.copy(), self.right.copy()  # factors of the old ones may be kept
        self.matrix[:, upper] -= self.matrix[:, lower] @ taken
        self.matrix[upper] -= taken.T @ self.matrix[lower]
        self.right[upper] -= taken.T @ self.right[lower]

    def expanded(self, columns: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """(p, ...) weights of all columns as they were given, from weights (a, ...) of some columns as they are."""
        full = np.zeros((self.size, *weights.shape[1:]))
        np.add.at(full, columns, weights)  # a law and its family may both hold a column
        for lower, upper, taken in reversed(self.moves):
            full[lower] -= taken @ full[upper]
        return full

    def predicted(self, columns: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """(N,) what some columns with these weights explain, what is free projected off."""
        full = self.expanded(columns, weights)
        inside = np.flatnonzero(full)
        rows = self.raw[:, inside] @ full[inside] if len(inside) < self.size // 2 else self.raw @ full
        return self.projected(self.unit * rows[:, None])[:, 0]

    def left(self, columns: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """(N,) what they leave of the response."""
        return self.response - self.predicted(columns, weights)

    def explicit(self, columns: np.ndarray, rows: slice = slice(None)) -> np.ndarray:
        """(N, a) some columns as they are now, or some rows of them."""
        full = self.unit * self.expanded(columns, np.eye(len(columns)))
        inside = np.flatnonzero(full.any(axis=1))
        taken, free = self._taken[:, inside] @ full[inside], self.basis.shape[1]
        out = self.raw[rows, inside] if len(inside) == 1 else self.raw[rows][:, inside]
        out = out.reshape(-1, len(inside)) @ full[inside] - self.basis[rows] @ taken[:free]
        return out if self.absorbed is None else out - self.absorbed.spread(taken[free:], rows)


def _orthonormal(columns: np.ndarray) -> np.ndarray:
    """Orthonormal basis of what the columns (N, f) span; dependent ones are left out."""
    norm = np.sqrt(np.einsum("nf,nf->f", columns, columns))
    scaled = columns[:, norm > 0] / norm[norm > 0]
    if not scaled.shape[1]:
        return np.zeros((len(columns), 0))
    q, r = np.linalg.qr(scaled)
    keep = np.abs(np.diag(r)) > _DEPENDENT
    if keep.all():
        return q
    left, values, _ = np.linalg.svd(scaled, full_matrices=False)
    return left[:, values > _DEPENDENT * values[0]]
