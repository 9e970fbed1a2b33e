"""What could stand in the place of each group of a selection: only what may bring enough is weighed.

With C the inverse of M, S = C_BB^-1 and u = G C_B, leaving out the block B gives u S u' back to what is left of the
Gram matrix and u S w_B to what is left of X'y. As the Gram matrix only grows by that, a group brings beside the rest
at most

    fit(h' (G + I / gamma_max)^-1 h) - 1/2 ln |I + gamma_min G| - its penalty,

with G what is left of its columns beside the whole selection and h what is left of X'y beside the rest. That G is the
same for every block that is left out: the bounds of all groups beside all rests are a few products.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.regression.solved import Beside

if TYPE_CHECKING:
    from app.diagnosis.regression.evidence import Evidence

#: nats that rounding may take from a bound.
SLACK = 0.01


class Instead:
    """All groups beside a selection without each of its groups."""

    def __init__(self, evidence: Evidence, selection: Mapping[int, float]):
        self.evidence, self.inside = evidence, evidence.inside(selection)
        self.now = evidence.beside(evidence.factor(selection))
        self._at = {g: i for i, g in enumerate(selection)}
        inside = self.inside
        moves = np.zeros((len(inside.inverse), len(self._at)))
        self.residual = np.zeros(len(self._at))
        for g, i in self._at.items():
            block, weights, self.residual[i] = inside.block(g)
            moves[:, i] = inside.inverse[:, inside.at[g]] @ (block @ weights)
        self._rows = evidence.statistics.matrix[inside.columns]  # (a, p)
        self.right = self.now.right[:, None] + self._rows.T @ moves
        self.bounds = self._bounds()

    def _bounds(self) -> np.ndarray:
        """(groups, n) what each group could bring at most beside the selection without each of its n groups [nats]."""
        e = self.evidence
        layout = e.layout()
        taken, occam = np.zeros((layout.count, len(self._at))), np.zeros(layout.count)
        for kind, (ids, widths) in enumerate(zip(layout.ids, layout.widths, strict=True)):
            own, block = layout.kind == kind, e.blocks(self.now, ids)
            least, most = float(widths.min()), float(widths.max())
            right = self.right[ids]  # (b, d, n)
            if ids.shape[1] == 1:
                gram = np.maximum(block[:, 0], 0.0)
                taken[own] = right[:, 0] ** 2 / (gram + 1.0 / most)
                occam[own] = 0.5 * np.log1p(least * gram[:, 0])
                continue
            eye = np.eye(ids.shape[1])
            rounding = 1.0 / most + 1e-12 * np.trace(block, axis1=1, axis2=2)[:, None, None]
            taken[own] = np.einsum("bdn,bdn->bn", right, np.linalg.solve(block + rounding * eye, right))
            occam[own] = 0.5 * np.maximum(np.linalg.slogdet(eye + least * block)[1], 0.0)
        left = np.maximum(self.residual - taken, 1e-9 * self.residual)
        fit = np.asarray(e.fit(left, self.residual))
        return fit - (occam + layout.penalty)[:, None] + SLACK

    def may(self, g: int, nats: float) -> set[int]:
        """Groups that may bring more than so many nats beside the selection without group g."""
        return set(np.flatnonzero(self.bounds[:, self._at[g]] > nats).tolist())

    def gains(self, g: int, candidates: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
        """What a few groups would add to the selection without group g, and their widths: see `Evidence.gains`."""
        inside, e = self.inside, self.evidence
        block, _, residual = inside.block(g)
        columns = np.unique(np.concatenate([e.groups[k].columns for k in candidates]))
        back = np.zeros((len(block), self.right.shape[0]))
        own = inside.inverse[inside.at[g]] @ self._rows[:, columns]
        back[:, columns] = np.linalg.cholesky(0.5 * (block + block.T)).T @ own
        return e.gains_beside(Beside(residual, self.right[:, self._at[g]], self.now.cross, back), candidates)
