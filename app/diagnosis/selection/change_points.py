"""At which row something changed: every row at once, by sums from the end."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.regression.design import Absorbed, Design
from app.diagnosis.regression.triangular import lower_solved
from app.diagnosis.thresholds.evidence import STEP, WIDTHS
from app.diagnosis.thresholds.rows import STEP_EDGE, STEP_EDGE_SHARE, STEP_GAP

if TYPE_CHECKING:
    from app.diagnosis.regression.evidence import Evidence, Factor, Selection


#: First rows that are tried at once; of longer recordings every so many rows first, then all rows around the best.
_AT_ONCE = 200
#: nats, beside a fifth of the best: a kind further below it at every so many rows is not looked at row by row. Half a
#: stride off costs a kind a tenth of what it brings at most.
_OFF = 10.0
#: nats by which the prices of a change at an early and a late row differ at most: rows whose fit alone is worse by more
#: are not weighed further.
_PAID_ALIKE = 10.0


@dataclass(frozen=True, eq=False)
class Kind:
    """Something that may change at a row and stay changed.

    Args:
        columns: (m, k, d) whitened, scaled to nominal sizes, as if it had been there from the first row on.
        cap: largest width in multiples of the nominal size.
        label: whatever the caller wants to know it by.
    """

    columns: np.ndarray
    cap: float
    label: object


@dataclass(frozen=True)
class Change:
    """The best row of one kind: gain [nats, penalty included] and width."""

    kind: Kind
    row: int
    gain: float
    gamma: float


class Scanner:
    """Scans one linear problem for changes of several kinds, all kinds side by side.

    With c the columns masked to rows >= r and Z an orthonormal basis of all that is free or selected,
    c'c - (Z'c)'(Z'c) and c'e are sums over the rows from r on. What does not depend on the selection is summed once.
    """

    def __init__(self, design: Design, kinds: Sequence[Kind]):
        self.kinds = list(kinds)
        self.m, self.k = kinds[0].columns.shape[:2]
        self.columns = np.concatenate([kind.columns for kind in kinds], axis=2)  # (m, k, D)
        ends = np.cumsum([0, *(kind.columns.shape[2] for kind in kinds)]).tolist()
        self.at = [slice(a, b) for a, b in pairwise(ends)]
        self.edges = np.arange(0, self.m, -(-self.m // _AT_ONCE))
        self.own = [_from_end(_squares(design.absorbed, kind.columns)) for kind in kinds]
        self._born, self.basis = design.unit, np.zeros(0)
        self.basis = self._crossed(design.basis)
        self._renew(design)

    def restated(self, design: Design) -> Scanner:
        """The same for a design that was restated."""
        out = copy(self)
        out._renew(design)
        return out

    def _renew(self, design: Design) -> None:
        self.design, self.unit = design, design.unit / self._born
        right = np.einsum("mkd,mk->md", self.columns, design.response.reshape(self.m, self.k))
        self.right = _from_end(right) * self.unit
        self._known: dict[int, int] = {}
        self._crosses = np.zeros((len(self.edges), self.columns.shape[2], 0))

    def best(
        self, evidence: Evidence, selection: Selection, taken: Sequence[tuple[object, int]], least: float
    ) -> list[Change]:
        """The best first row of each kind that can bring at least so much [nats], given what is selected.

        Args:
            taken: label and row of changes that are in already; nearby rows of the same label are no candidates.
        """
        edge = max(STEP_EDGE, int(STEP_EDGE_SHARE * self.m))
        if self.m <= 2 * edge:
            return []
        factor = evidence.factor(selection)
        near = [[row for label, row in taken if label == kind.label] for kind in self.kinds]
        rows = self.edges[(self.edges >= edge) & (self.edges < self.m - edge)]
        every = len(self.edges) == self.m
        found = self._among(
            evidence, factor, range(len(self.kinds)), rows, near, least - (0.0 if every else _OFF)
        )
        if every or not found:
            return [change for _, change in found]
        step, out, top = int(self.edges[1]), [], max(change.gain for _, change in found)
        for i, change in found:
            if change.gain > 0.8 * top - _OFF:
                rows = np.arange(max(change.row - step, edge), min(change.row + step + 1, self.m - edge))
                out += [fine for _, fine in self._among(evidence, factor, [i], rows, near, least)]
        return out

    def _among(
        self,
        evidence: Evidence,
        factor: Factor,
        which: Sequence[int],
        rows: np.ndarray,
        near: list[list[int]],
        least: float,
    ) -> list[tuple[int, Change]]:
        """The best of some rows for each of some kinds that can bring at least so much [nats]."""
        part = slice(None) if len(which) > 1 else self.at[which[0]]
        half, basis, right = self._beside(rows, factor, part)
        sizes: dict[int, list[int]] = {}
        for i in which:
            sizes.setdefault(self.at[i].stop - self.at[i].start, []).append(i)
        penalty, out = STEP + np.log(self.m), []
        for size, some in sizes.items():
            places = [np.arange(size) + (self.at[i].start if part == slice(None) else 0) for i in some]
            gram = np.stack([self.own[i][rows] for i in some]) * self.unit**2  # (kinds, r, d, d)
            for known in (basis, half):
                block = known[:, np.array(places)].transpose(1, 0, 2, 3)  # (kinds, r, d, a)
                gram = gram - block @ np.swapaxes(block, 2, 3)
            own = right[:, np.array(places)].transpose(1, 0, 2)
            most = evidence.most(gram, own, factor.residual, WIDTHS) - penalty  # (kinds, r)
            for k, i in enumerate(some):
                for row in near[i]:
                    most[k, np.abs(rows - row) < STEP_GAP] = -np.inf
            top = most.max(axis=1, keepdims=True)
            kind, row = np.nonzero((most > top - _PAID_ALIKE) & (most >= least))
            if not len(kind):
                continue
            values, squares = gram[kind, row, :, 0], own[kind, row] ** 2
            if size > 1:
                values, vectors = np.linalg.eigh(gram[kind, row])
                squares = (own[kind, row][:, None] @ vectors)[:, 0] ** 2
            gain, gamma = evidence.best_width(
                np.maximum(values, 0.0), squares, factor.residual,
                np.array([self.kinds[i].cap for i in some])[kind], np.full(len(kind), penalty), WIDTHS,
            )  # fmt: skip
            for k in np.unique(kind).tolist():
                mine = np.flatnonzero(kind == k)
                best = mine[gain[mine].argmax()]
                change = Change(
                    self.kinds[some[k]], int(rows[row[best]]), float(gain[best]), float(gamma[best])
                )
                out.append((some[k], change))
        return out

    def _beside(
        self, rows: np.ndarray, factor: Factor, part: slice
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Products with the selection (r, D, a) and with what is free (r, D, f), in orthonormal columns; right."""
        index = np.searchsorted(self.edges, rows)
        near = self.edges[np.minimum(index, len(self.edges) - 1)]
        piece = None if np.array_equal(near, rows) else self._piece(rows)
        basis = self._sums(index, rows, piece, part, self.basis, self.design.basis)
        right = self.right[rows][:, part]
        if not len(factor.columns):
            return basis[:, :, :0], basis * self.unit, right
        known = self._known_as(factor.columns)
        inner = None if piece is None else self.design.explicit(factor.columns, piece)
        cross = self._sums(index, rows, piece, part, self._crosses, inner, known)
        r, d, a = cross.shape
        half = lower_solved(factor.lower, cross.reshape(r * d, a).T)
        right = right - self.unit * (half.T @ factor.solved).reshape(r, d)
        return self.unit * half.T.reshape(r, d, a), basis * self.unit, right

    def _piece(self, rows: np.ndarray) -> slice:
        """Rows of the problem (N) from the first of some neighbouring rows to the next edge."""
        after = int(np.searchsorted(self.edges, rows[-1], side="right"))
        stop = int(self.edges[after]) if after < len(self.edges) else self.m
        return slice(int(rows[0]) * self.k, stop * self.k)

    def _sums(
        self,
        index: np.ndarray,
        rows: np.ndarray,
        piece: slice | None,
        part: slice,
        at_edges: np.ndarray,
        matrix: np.ndarray | None,
        which: list[int] | slice = slice(None),
    ) -> np.ndarray:
        """(r, D, p) sums from some rows on: those at edges, or between edges with what lies before the next one.

        Args:
            at_edges: (edges, D, p) the sums at edges.
            matrix: the rows of `piece` (or all rows, of which they are cut) that the columns are multiplied with.
            which: of the last axis of `at_edges`.
        """
        if piece is None:
            return at_edges[index][:, part][:, :, which]
        assert matrix is not None
        first, stop = piece.start // self.k, piece.stop // self.k
        matrix = matrix[piece] if len(matrix) == self.m * self.k else matrix
        columns = np.swapaxes(self.columns[first:stop, :, part], 1, 2)
        inner = _from_end(columns @ matrix.reshape(stop - first, self.k, -1))[: len(rows)]
        after = int(np.searchsorted(self.edges, stop))
        return inner + (at_edges[after][part][:, which] if after < len(self.edges) else 0.0)

    def _known_as(self, columns: np.ndarray) -> list[int]:
        """Where sums with some columns of the design stand in `_crosses`; worked out when first asked for."""
        new = [c for c in dict.fromkeys(columns.tolist()) if c not in self._known]
        if new:
            more = self._crossed(self.design.explicit(np.array(new)))
            self._known.update({c: self._crosses.shape[2] + i for i, c in enumerate(new)})
            self._crosses = np.concatenate([self._crosses, more], axis=2)
        return [self._known[c] for c in columns.tolist()]

    def _crossed(self, matrix: np.ndarray) -> np.ndarray:
        """(edges, D, p): columns times matrix (N, p), summed from each edge to the end."""
        m, k, d = self.columns.shape
        p = matrix.shape[1]
        if len(self.edges) == m:
            return _from_end(np.swapaxes(self.columns, 1, 2) @ matrix.reshape(m, k, p))
        out = np.empty((len(self.edges), d, p))
        for i, (a, b) in enumerate(pairwise([*self.edges.tolist(), m])):
            out[i] = self.columns[a:b].reshape(-1, d).T @ matrix[a * k : b * k]
        return _from_end(out)


def _squares(absorbed: Absorbed | None, columns: np.ndarray) -> np.ndarray:
    """(m, d, d): by how much the Gram matrix of masked columns grows with each row."""
    own = np.einsum("mkd,mke->mde", columns, columns)
    return own if absorbed is None else own - _absorbed_steps(absorbed, columns)


def _from_end(values: np.ndarray) -> np.ndarray:
    """Sums over this row and all later ones."""
    return np.cumsum(values[::-1], axis=0)[::-1]


def _absorbed_steps(absorbed: Absorbed, columns: np.ndarray) -> np.ndarray:
    """(m, d, d): by how much the absorbed parameters' share of the masked Gram matrix grows with each row."""
    m, k, d = columns.shape
    label, entry = absorbed.label, absorbed.entry
    norm = np.maximum(np.bincount(label, entry**2), 1e-300)
    weighted = columns.reshape(m * k, d) * entry[:, None]
    # within a label, the last rows first; sums there are differences of one running sum
    order = np.lexsort((-np.arange(m * k), label))
    running = np.cumsum(weighted[order], axis=0)
    starts = np.flatnonzero(np.r_[True, np.diff(label[order]) != 0])
    before = np.concatenate([np.zeros((1, d)), running[starts[1:] - 1]])
    new = running - np.repeat(before, np.diff(np.r_[starts, m * k]), axis=0)
    old = new - weighted[order]
    grown = (new[:, :, None] * new[:, None, :] - old[:, :, None] * old[:, None, :]) / norm[label[order]][
        :, None, None
    ]
    out = np.empty_like(grown)
    out[order] = grown
    return out.reshape(m, k, d, d).sum(axis=1)
