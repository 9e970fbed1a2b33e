"""Log evidence of a set of groups of columns, gains of all others, and the posterior.

A group g has weights w_g ~ N(0, gamma_g sigma^2 I) in columns that are scaled to the nominal sizes; gamma_g is
learnt (empirical Bayes) from a grid and capped. With R the penalised residual,

    L(S) = -(nu/2) ln R(S) - 1/2 ln |I + Gamma G| - sum of penalties          sigma profiled out
    L(S) = -R(S) / 2       - 1/2 ln |I + Gamma G| - sum of penalties          unit noise

Source: Bayesian linear regression, MacKay, "Bayesian interpolation", Neural Computation 4 (1992), eq. 2.18 ff.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from app.diagnosis.regression.groups import Group, Layout, Selection
from app.diagnosis.regression.inside import ROUNDING, Inside
from app.diagnosis.regression.instead import Instead
from app.diagnosis.regression.solved import Beside, Factor, Posterior, Statistics
from app.diagnosis.regression.triangular import inverse_of, lower_solved
from app.diagnosis.regression.usual import density
from app.diagnosis.regression.weighing import Weighing

__all__ = ["Beside", "Evidence", "Factor", "Group", "Posterior", "Selection", "Statistics"]


#: Factorised selections that are kept: what is scored is asked for its losses and for what could join it, too.
KEPT = 4


class Evidence(Weighing):
    """Evidence of selections among groups.

    Args:
        statistics: the design, or anything with its Gram matrix.
        groups: all groups; more may be appended.
        unit_noise: True where the whitened noise has unit variance for sure.
        kept: groups that stay in at the smallest width instead of falling out when they are tuned.
        alike: groups whose widths are much of a size with each other's, as far as rows do not say otherwise.
    """

    def __init__(self, statistics: Statistics, groups: Sequence[Group], *, unit_noise: bool = False):
        super().__init__(statistics, unit_noise=unit_noise)
        self.groups = list(groups)
        self.kept: set[int] = set()
        self.alike: set[int] = set()
        self._laid: Layout | None = None
        self._factors: dict[tuple, Factor] = {}
        self._factors_of: tuple[object, object] = (None, None)
        self._beside_last: tuple[Factor, Beside] | None = None
        self._inside_last: Inside | None = None
        self._inside_of: tuple[object, object] = (None, None)

    def factor(self, selection: Mapping[int, float]) -> Factor:
        """A selection factorised; those asked last are kept as long as the statistics stand."""
        s = self.statistics
        if not selection:
            none = np.zeros(0, int)
            return Factor(none, np.zeros((0, 0)), np.zeros(0), s.total, 0.0)
        if self._factors_of[0] is not s.matrix or self._factors_of[1] is not s.right:
            self._factors, self._factors_of = {}, (s.matrix, s.right)
        key = tuple(selection.items())
        if key not in self._factors:
            if len(self._factors) >= KEPT:
                del self._factors[next(iter(self._factors))]
            self._factors[key] = self._factorised(selection)
        return self._factors[key]

    def _factorised(self, selection: Mapping[int, float]) -> Factor:
        s = self.statistics
        columns, gamma = self._inside(selection)
        matrix = s.matrix[columns[:, None], columns]
        # Of columns that are alike to the last digits the sum of their weights is known, and no more.
        matrix.flat[:: len(matrix) + 1] += 1.0 / gamma + ROUNDING * np.diagonal(matrix)
        lower = np.linalg.cholesky(matrix)
        solved = lower_solved(lower, s.right[columns])
        residual = max(s.total - float(solved @ solved), 1e-9 * s.total, 1e-300)
        occam = float(np.log(np.diagonal(lower)).sum() + 0.5 * np.log(gamma).sum())
        return Factor(columns, lower, solved, residual, occam)

    def _inside(self, selection: Mapping[int, float]) -> tuple[np.ndarray, np.ndarray]:
        """(a,) columns of a selection and their widths."""
        groups = [self.groups[g].columns for g in selection]
        return np.concatenate(groups), np.repeat(list(selection.values()), [len(c) for c in groups])

    def score(self, selection: Mapping[int, float]) -> float:
        """L(S) beyond that of the empty selection [nats]."""
        f = self.factor(selection)
        penalties = sum(self.groups[g].penalty for g in selection)
        return float(self.fit(f.residual, max(self.statistics.total, 1e-300))) - f.occam - penalties

    def variance(self, factor: Factor) -> float:
        return 1.0 if self.unit_noise else factor.residual / self.statistics.dof

    def gains(
        self, selection: Mapping[int, float], candidates: Sequence[int]
    ) -> tuple[np.ndarray, np.ndarray]:
        """What each candidate would add to the evidence, penalty included, at its best width.

        Returns:
            gains (c,) [nats] and gammas (c,).
        """
        return self.gains_beside(self.beside(self.factor(selection)), candidates)

    def gains_beside(self, beside: Beside, candidates: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
        """The same where what is left of every column is known already."""
        layout, chosen = self.layout(), np.asarray(candidates, int)
        gains, gammas, kinds = np.empty(len(chosen)), np.empty(len(chosen)), layout.kind[chosen]
        for kind in np.unique(kinds).tolist():
            which = np.flatnonzero(kinds == kind)
            some = chosen[which]
            ids, rows = layout.ids[kind], layout.row[some]
            block = self.blocks(beside, ids[rows])
            if beside.back is not None:
                back = beside.back[:, ids[rows]].transpose(1, 0, 2)
                block = block + np.swapaxes(back, 1, 2) @ back
            gains[which], gammas[which] = self._batch(
                beside, ids[rows], block, layout.positive[some], layout.cap[some], layout.penalty[some],
                layout.widths[kind],
            )  # fmt: skip
        return gains, gammas

    def instead(self, selection: Mapping[int, float]) -> Instead:
        """What could stand in the place of each group of a selection."""
        return Instead(self, selection)

    def joint_gains(
        self, selection: Mapping[int, float], together: Sequence[tuple[int, ...]]
    ) -> tuple[np.ndarray, np.ndarray]:
        """The same for several groups at once, which share one width."""
        beside = self.beside(self.factor(selection))
        gains, gammas = np.empty(len(together)), np.empty(len(together))
        kinds: dict[tuple[int, int], list[int]] = {}  # of one size and one grid of widths go together
        columns = [np.concatenate([self.groups[g].columns for g in some]) for some in together]
        for i, some in enumerate(together):
            kinds.setdefault((len(columns[i]), id(self.groups[some[0]].widths)), []).append(i)
        for members in kinds.values():
            ids = np.array([columns[i] for i in members])
            gains[members], gammas[members] = self._batch(
                beside, ids, self.blocks(beside, ids), np.zeros(len(members), bool),
                np.array([min(self.groups[g].cap for g in together[i]) for i in members]),
                np.array([sum(self.groups[g].penalty for g in together[i]) for i in members]),
                self.groups[together[members[0]][0]].widths,
            )  # fmt: skip
        return gains, gammas

    def layout(self) -> Layout:
        """All groups sorted by size and widths; made anew when groups joined."""
        if self._laid is None or self._laid.count != len(self.groups):
            self._laid = Layout.of(self.groups)
        return self._laid

    def beside(self, factor: Factor) -> Beside:
        """What is left of every column beside a selection."""
        if self._beside_last is not None and self._beside_last[0] is factor:
            return self._beside_last[1]
        s = self.statistics
        if not len(factor.columns):
            return Beside(factor.residual, s.right, np.zeros((0, len(s.right))))
        cross = lower_solved(factor.lower, s.matrix[factor.columns])
        found = Beside(factor.residual, s.right - factor.solved @ cross, cross)
        self._beside_last = factor, found
        return found

    def blocks(self, beside: Beside, ids: np.ndarray) -> np.ndarray:
        """(b, d, d) Gram matrices of groups with columns ids (b, d), the selection out."""
        if ids.shape[1] == 1:
            flat = ids[:, 0]
            cross = beside.cross[:, flat]
            return (self.statistics.matrix[flat, flat] - np.einsum("ab,ab->b", cross, cross))[:, None, None]
        block = self.statistics.matrix[ids[:, :, None], ids[:, None, :]]
        if len(beside.cross):
            part = beside.cross[:, ids].transpose(1, 0, 2)  # (b, a, d)
            block = block - np.swapaxes(part, 1, 2) @ part
        return block

    def _batch(
        self, beside: Beside, ids, block, positive, cap, penalty, widths
    ) -> tuple[np.ndarray, np.ndarray]:
        """Gains and gammas of groups with columns ids (b, d) and Gram matrices block (b, d, d)."""
        own = beside.right[ids]
        if ids.shape[1] > 1:
            return self.best_width_of_blocks(block, own, beside.residual, cap, penalty, widths)
        squares = np.where((positive & (own[:, 0] < 0))[:, None], 0.0, own**2)
        return self.best_width(np.maximum(block[:, 0], 0.0), squares, beside.residual, cap, penalty, widths)

    def losses(self, selection: Mapping[int, float]) -> dict[int, float]:
        """Evidence lost without each group of a selection [nats], its penalty counted.

        With M = G + Gamma^-1, C its inverse and w the weights, taking out the block B adds w_B' C_BB^-1 w_B to the
        residual and takes ln |C_BB^-1| + ln |Gamma_B| from the log determinant.
        """
        return self.inside(selection).losses() if selection else {}

    def inside(self, selection: Mapping[int, float]) -> Inside:
        """The groups of a selection, each beside the others: carried on from the last one where few have changed."""
        last, of = self._inside_last, (self.statistics.matrix, self.statistics.right)
        same = self._inside_of[0] is of[0] and self._inside_of[1] is of[1]
        if last is None or not same or not self.unit_noise or not last.carried_to(selection):
            last = self._inside_last = Inside(self, selection)
            self._inside_of = of
        return last

    def tuned(
        self, selection: Mapping[int, float], sweeps: int = 2, bound: Collection[int] = ()
    ) -> Selection:
        """Every width at its best given the others; groups that are better off without a width fall out.

        They are asked by turns, the least worthy of a turn first: which of several that can stand for each other falls
        out does not hang on the order of the library.

        Args:
            bound: groups that stay in whatever they are worth, beside those that are kept.
        """
        now, stays = dict(selection), self.kept.union(bound)
        for _ in range(sweeps):
            if not now:
                break
            inside, before = self.inside(now), dict(now)
            losses = inside.losses()
            for g in sorted(now, key=lambda g: (-self.groups[g].turn, losses[g])):
                if g in stays and self.groups[g].widths.tolist() == [now[g]]:
                    continue
                gain, gamma = inside.best_width(g, self._expected(g, now))
                if gain > 0 or g in stays:
                    now[g] = gamma
                    inside.widen(g, gamma)
                else:
                    del now[g]
                    inside.drop(g)
            if now == before:
                break
        return now

    def _expected(self, g: int, now: Mapping[int, float]) -> np.ndarray | None:
        """(w,) log density of each width of a group; None where one is as likely as another."""
        others = [now[h] for h in self.alike if h in now and h != g] if g in self.alike else []
        noise = None if self.unit_noise else self.variance(self.factor(now))
        return density(self.groups[g].widths, noise, others)

    def posterior(self, selection: Mapping[int, float]) -> Posterior:
        f = self.factor(selection)
        variance = self.variance(f)
        if not len(f.columns):
            return Posterior(f.columns, np.zeros(0), np.zeros((0, 0)), variance)
        weights = lower_solved(f.lower, f.solved, transposed=True)
        inverse = inverse_of(f.lower) * variance
        columns, where = np.unique(f.columns, return_inverse=True)
        if len(columns) == len(f.columns):
            return Posterior(f.columns, weights, inverse, variance)
        # A law and its family both in: the same column twice, its weights add up.
        merge = np.zeros((len(columns), len(f.columns)))
        merge[where, np.arange(len(f.columns))] = 1.0
        covariance = merge @ inverse @ merge.T
        return Posterior(columns, merge @ weights, covariance, variance)
