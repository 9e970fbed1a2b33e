"""What a group of a selection is worth beside the others, from one inverse for all of them."""

from __future__ import annotations

from collections.abc import Mapping
from math import log
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.regression.triangular import inverse_of, lower_solved

if TYPE_CHECKING:
    from app.diagnosis.regression.evidence import Evidence

#: Relative: keeps the Gram matrix of nearly equal columns positive.
ROUNDING = 1e-9


class Inside:
    """A selection by the inverse C of its M: what one group is worth beside the others, without another factor."""

    def __init__(self, evidence: Evidence, selection: Mapping[int, float]):
        self.evidence, self.gamma = evidence, dict(selection)
        f = evidence.factor(selection)
        self.inverse, self.weights = inverse_of(f.lower), lower_solved(f.lower, f.solved, transposed=True)
        self.residual = f.residual
        ends = np.cumsum([0, *(len(evidence.groups[g].columns) for g in selection)]).tolist()
        self.at = {g: slice(a, b) for g, a, b in zip(selection, ends, ends[1:], strict=False)}

    def block(self, g: int) -> tuple[np.ndarray, np.ndarray, float]:
        """C_BB^-1, the group's weights, and the residual without it."""
        part = self.at[g]
        w, own = self.weights[part], self.inverse[part, part]
        block = 1.0 / own if len(w) == 1 else np.linalg.inv(own)
        return block, w, self.residual + float(w @ block @ w)

    def losses(self) -> dict[int, float]:
        out, e = {}, self.evidence
        for g, gamma in self.gamma.items():
            block, w, without = self.block(g)
            logdet = float(np.log(block[0, 0])) if len(w) == 1 else float(np.linalg.slogdet(block)[1])
            fit = float(e.fit(self.residual, without))
            out[g] = fit - 0.5 * logdet - 0.5 * len(w) * float(np.log(gamma)) - e.groups[g].penalty
        return out

    def best_width(self, g: int, expected: np.ndarray | None = None) -> tuple[float, float]:
        """Gain [nats], penalty not counted, and width of a group beside the others.

        Args:
            expected: (w,) log density of each of its widths; None where one is as likely as another.
        """
        e, group = self.evidence, self.evidence.groups[g]
        block, w, without = self.block(g)
        if expected is None and len(w) == 1 and e.unit_noise and group.cap == np.inf:
            return self._single(g, float(block[0, 0]), float(w[0]))
        diagonal = e.statistics.matrix[group.columns, group.columns]
        gram = block - np.diag(1.0 / self.gamma[g] + ROUNDING * diagonal)
        right = block @ w
        if len(w) == 1:
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

    def _single(self, g: int, block: float, weight: float) -> tuple[float, float]:
        """The same of one column beside known noise: a few numbers, which arrays would take ten times as long for."""
        group = self.evidence.groups[g]
        k = int(group.columns[0])
        value = max(
            block - 1.0 / self.gamma[g] - ROUNDING * float(self.evidence.statistics.matrix[k, k]), 0.0
        )
        right = block * weight
        square = 0.0 if group.positive and right < 0 else right * right
        best = (-np.inf, 0.0)
        for gamma in group.widths.tolist():
            stretch = 1.0 + gamma * value
            gain = 0.5 * square * gamma / stretch - 0.5 * log(stretch)
            best = (gain, gamma) if gain > best[0] else best
        return best

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

    def _less(self, over: np.ndarray, step: np.ndarray, w: np.ndarray) -> None:
        self.residual += float(w @ step @ w)
        self.weights = self.weights - over @ (step @ w)
        self.inverse = self.inverse - (over @ step) @ over.T
