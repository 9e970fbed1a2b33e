"""What a group of a selection is worth beside the others, from one inverse for all of them."""

from __future__ import annotations

from collections.abc import Mapping
from math import log
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.regression.triangular import inverse_of, lower_solved
from app.diagnosis.regression.weighing import FEW_WIDTHS

if TYPE_CHECKING:
    from app.diagnosis.regression.evidence import Evidence

#: Relative: keeps the Gram matrix of nearly equal columns positive.
ROUNDING = 1e-9
#: Changes of a selection after which its inverse is worked out anew.
CHANGES = 80


class Inside:
    """A selection by the inverse C of its M: what one group is worth beside the others, without another factor.

    The inverse is carried on when groups are widened and dropped.
    """

    def __init__(self, evidence: Evidence, selection: Mapping[int, float]):
        self.evidence, self.gamma = evidence, dict(selection)
        f = evidence.factor(selection)
        self.inverse, self.weights = inverse_of(f.lower), lower_solved(f.lower, f.solved, transposed=True)
        self.residual, self.columns = f.residual, f.columns
        ends = np.cumsum([0, *(len(evidence.groups[g].columns) for g in selection)]).tolist()
        self.at = {g: slice(a, b) for g, a, b in zip(selection, ends, ends[1:], strict=False)}
        self.changes = 0
        self._kinds: dict[tuple[int, int], list[int]] = {}  # as long as nothing is dropped
        self._widths: dict[tuple, dict[int, tuple[float, float]]] = {}  # as long as nothing changes

    def block(self, g: int) -> tuple[np.ndarray, np.ndarray, float]:
        """C_BB^-1, the group's weights, and the residual without it."""
        part = self.at[g]
        w, own = self.weights[part], self.inverse[part, part]
        block = 1.0 / own if len(w) == 1 else np.linalg.inv(own)
        return block, w, self.residual + float(w @ block @ w)

    def losses(self) -> dict[int, float]:
        """Evidence lost without each group [nats], its penalty counted."""
        out, e = dict.fromkeys(self.gamma, 0.0), self.evidence
        for some in self._alike().values():
            own, w, gamma = self._of(some)
            right = np.linalg.solve(own, w[..., None])[..., 0]
            without = self.residual + np.einsum("bd,bd->b", w, right)
            logs = w.shape[1] * np.log(gamma) - np.linalg.slogdet(own)[1]
            fit = np.asarray(e.fit(self.residual, without))
            out.update(
                zip(some, (fit - 0.5 * logs - [e.groups[g].penalty for g in some]).tolist(), strict=True)
            )
        return out

    def best_width(self, g: int, expected: np.ndarray | None = None) -> tuple[float, float]:
        """Gain [nats], penalty not counted, and width of a group beside the others.

        Args:
            expected: (w,) log density of each of its widths; None where one is as likely as another.
        """
        e, group = self.evidence, self.evidence.groups[g]
        one = len(group.columns) == 1
        if (
            expected is None
            and e.unit_noise
            and group.cap == np.inf
            and (one or len(group.widths) <= FEW_WIDTHS)
        ):
            key = (len(group.columns), id(group.widths))
            if key not in self._widths:
                self._widths[key] = self._best_widths(self._alike()[key])
            return self._widths[key][g]
        block, w, without = self.block(g)
        diagonal = e.statistics.matrix[group.columns, group.columns]
        gram = block - np.diag(1.0 / self.gamma[g] + ROUNDING * diagonal)
        right = block @ w
        if one:
            values, squares = gram, right[None] ** 2
            if group.positive and right[0] < 0:
                squares = np.zeros((1, 1))
        else:
            values, vectors = np.linalg.eigh(gram)
            values, squares = values[None], (right @ vectors)[None] ** 2
        gain, gamma = e.best_width(
            np.maximum(values, 0.0), squares, without, group.cap, 0.0, group.widths, expected
        )
        return float(gain[0]), float(gamma[0])

    def _best_widths(self, some: list[int]) -> dict[int, tuple[float, float]]:
        """The same beside known noise, of all groups of one size and one grid of widths.

        With D what another width adds to M, C_BB^-1 + D = C_BB^-1 (I + C_BB D).
        """
        e, widths = self.evidence, self.evidence.groups[some[0]].widths
        own, w, gamma = self._of(some)
        columns = np.array([e.groups[g].columns for g in some])
        rounding = ROUNDING * e.statistics.matrix[columns, columns]
        d = w.shape[1]
        if d == 1:
            block = 1.0 / own[:, 0, 0]
            right = block * w[:, 0]
            positive = np.array([e.groups[g].positive for g in some])
            squares = np.where(positive & (right < 0), 0.0, right**2)
            stretch = 1.0 + widths[:, None] * np.maximum(block - 1.0 / gamma - rounding[:, 0], 0.0)
            taken, logs = squares * widths[:, None] / stretch, np.log(stretch)
        else:
            right, size = np.linalg.solve(own, w[..., None])[..., 0], np.linalg.slogdet(own)[1]
            taken, logs = np.empty((len(widths), len(some))), np.empty((len(widths), len(some)))
            for k, width in enumerate(widths.tolist()):
                change = 1.0 / width - 1.0 / gamma[:, None] - rounding
                inner = np.eye(d) + own * change[:, None, :]
                taken[k] = np.einsum("bd,bd->b", right, np.linalg.solve(inner, w[..., None])[..., 0])
                logs[k] = np.linalg.slogdet(inner)[1] - size + d * log(width)
        gain = 0.5 * (taken - logs)
        best = gain.argmax(axis=0)
        gains = gain[best, np.arange(len(some))].tolist()
        return dict(zip(some, zip(gains, widths[best].tolist(), strict=True), strict=True))

    def _alike(self) -> dict[tuple[int, int], list[int]]:
        """Groups of one size and one grid of widths."""
        if not self._kinds:
            for g in self.gamma:
                group = self.evidence.groups[g]
                self._kinds.setdefault((len(group.columns), id(group.widths)), []).append(g)
        return self._kinds

    def _of(self, some: list[int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(b, d, d) blocks of C, (b, d) weights and (b,) widths of groups of one size."""
        first = np.array([self.at[g].start for g in some])
        at = first[:, None] + np.arange(self.at[some[0]].stop - self.at[some[0]].start)
        gamma = np.array([self.gamma[g] for g in some])
        return self.inverse[at[:, :, None], at[:, None, :]], self.weights[at], gamma

    def widen(self, g: int, gamma: float) -> None:
        """Gives a group another width: M gains a diagonal block."""
        change = 1.0 / gamma - 1.0 / self.gamma[g]
        self.gamma[g] = gamma
        if change == 0.0:
            return
        part = self.at[g]
        over, w = self.inverse[:, part], self.weights[part]
        step = np.linalg.inv(np.eye(len(w)) / change + self.inverse[part, part])
        self._less(over, step, w)

    def drop(self, g: int) -> None:
        """Takes a group out."""
        part = self.at[g]
        block, w, _ = self.block(g)
        self._less(self.inverse[:, part].copy(), block, w.copy())
        self.inverse[part], self.inverse[:, part], self.weights[part] = 0.0, 0.0, 0.0
        del self.gamma[g], self.at[g]
        self._kinds = {}

    def carried_to(self, selection: Mapping[int, float]) -> bool:
        """Makes it that of a part of the selection, or of other widths; False, and it is of no use, where it cannot.

        A group that joins is no such change: what is left of a column that the selection nearly has is lost in the
        rounding of the inverse.
        """
        gone = [g for g in self.gamma if g not in selection]
        other = [g for g, v in selection.items() if self.gamma.get(g) != v]
        groups = self.evidence.groups
        moved = sum(len(groups[g].columns) for g in (*gone, *other))
        joined = any(g not in self.gamma for g in other)
        if joined or self.changes > CHANGES or 4 * moved > len(self.columns):
            return False
        for g in gone:
            self.drop(g)
        for g in other:
            self.widen(g, selection[g])
        return True

    def _changed(self) -> None:
        self.changes += 1
        self._widths = {}

    def _less(self, over: np.ndarray, step: np.ndarray, w: np.ndarray) -> None:
        self.residual += float(w @ step @ w)
        self.weights = self.weights - over @ (step @ w)
        self.inverse = self.inverse - (over @ step) @ over.T
        self._changed()
