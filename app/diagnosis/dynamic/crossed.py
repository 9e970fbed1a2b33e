"""Selections by what they predict: the error on stretches of the log left out, from Gram matrices joint by joint.

Evidence takes the noise for known. Where a model is not complete, what it leaves hangs together and the evidence of
small laws is too high: there a law stays only if the log is predicted worse without it. And whatever the evidence
prefers, a description that predicts plainly better is taken instead: masses, friction, offsets and rotors of all
joints, each within the trust that it has before anything is measured, alone or with the other laws beside them, and the
description itself. All are weighed as they will be solved: by the noise of plain least squares.

Which description is taken is asked of whole parts of the log, a fifth at once: another log is farther away than any gap
between two stretches, and masses that a short motion hardly tells fit every gap.

Source: Geisser (1975), The predictive sample reuse method, JASA 70; stretches because neighbours hang together.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from app.diagnosis.dynamic.families import ordinary
from app.diagnosis.dynamic.solution import FOLDS, folds_of, parts_of, plain_noise
from app.diagnosis.regression.evidence import Selection
from app.diagnosis.regression.triangular import inverse_of
from app.diagnosis.thresholds.predicting import PLAINLY, TRUSTED, WORTH

if TYPE_CHECKING:
    from app.diagnosis.dynamic.study import Study


JITTER = 1e-11  # of the diagonal: keeps nearly dependent columns positive


def by_prediction(study: Study, unfinished: bool) -> Selection:
    """The study's selection, or one that predicts the log better.

    Args:
        unfinished: True where structure is left.
    """
    chosen = study.selection
    if study.prior is not None:
        return _earned(study) if unfinished else chosen
    every = dict.fromkeys(ordinary(study), TRUSTED)
    events = [g for g in chosen if not study.label(g).law.lasting]
    kept = {g: v for g, v in chosen.items() if g in study.evidence.kept or g in events}
    alone, beside = {**kept, **every}, {**_beside(study, chosen, every), **every}
    far = Crossed(study, {**chosen, **every}, parts_of(len(study.y)), events)
    if not unfinished:
        plainly = (1.0 - PLAINLY) * far.total(chosen)
        if study.state.joints > 1:
            # What has no name would be pruned with a curve in time, and names be given without it: all of it stays.
            return beside if far.total(beside) < plainly else chosen
        if min(map(far.total, [alone, beside])) >= plainly:
            return chosen
    first = _earned(study)
    best = min([far.pruned(beside, every), alone, kept], key=far.total)
    return best if far.total(best) < (1.0 - PLAINLY) * far.total(first) else first


def _earned(study: Study) -> Selection:
    """The study's selection without the laws that stretches in turn are predicted no worse without."""
    return Crossed(study, study.selection, folds_of(len(study.y))).pruned(study.selection)


def _beside(study: Study, chosen: Selection, families: Collection[int]) -> Selection:
    """What of a selection stays beside whole families: nothing whose columns they have."""
    own = {c for g in families for c in study.group(g).columns.tolist()}
    return {g: v for g, v in chosen.items() if not own & set(study.group(g).columns.tolist())}


class Crossed:
    """Held-out errors of selections within some groups, every sample of a joint weighted alike.

    Args:
        widest: all groups that are asked.
        folds: (M,) turn in which each row is left out.
        known: groups of the study's selection whose torque is taken as it was fitted: an event that lies in what is
            left out is foretold by nothing, and is no reason for or against anything else.
    """

    def __init__(self, study: Study, widest: Selection, folds: np.ndarray, known: Collection[int] = ()):
        self.study = study
        self.known = frozenset(known)
        columns = sorted({c for g in widest if g not in self.known for c in study.group(g).columns.tolist()})
        self.at = {c: k for k, c in enumerate(columns)}
        design = study.design
        self.noise, left = plain_noise(study)
        #: Rows of one joint that count: slow noise hangs together.
        self.counts = len(study.y) * float(np.mean((left / self.noise) ** 2))
        self.size = len(columns)
        taken = _fitted(study, self.known)
        self.parts = []  # of each joint: its columns' places, products by fold, right sides and sums of squares
        for j in range(design.joints):
            here = [k for k, c in enumerate(design.at[j].tolist()) if c in self.at]
            ids = np.array([self.at[int(design.at[j][k])] for k in here], int)
            raw, y = design.raw[j][:, here], design.y[:, j] - taken[:, j]
            gram = np.stack([raw[folds == k].T @ raw[folds == k] for k in range(FOLDS)])
            right = np.stack([raw[folds == k].T @ y[folds == k] for k in range(FOLDS)])
            self.parts.append(
                (ids, gram, right, np.array([y[folds == k] @ y[folds == k] for k in range(FOLDS)]))
            )
        self._sum()
        self._errors_of: dict[tuple, np.ndarray] = {}

    def _sum(self) -> None:
        self.gram, self.right = np.zeros((FOLDS, self.size, self.size)), np.zeros((FOLDS, self.size))
        for (ids, gram, right, _), noise in zip(self.parts, self.noise, strict=True):
            for k in range(FOLDS):
                self.gram[k][np.ix_(ids, ids)] += gram[k] / noise**2
                self.right[k][ids] += right[k] / noise**2
        self.whole, self.every = self.gram.sum(axis=0), self.right.sum(axis=0)

    def errors(self, selection: Selection) -> np.ndarray:
        """(n,) sum of squares of each joint over the stretches left out [Nm^2]."""
        key = tuple(sorted(selection.items()))
        if key not in self._errors_of:
            self._errors_of[key] = self._errors(selection)
        return self._errors_of[key]

    def _errors(self, selection: Selection) -> np.ndarray:
        columns, precision = self._inside(selection)
        weights = np.zeros((FOLDS, self.size, 1))
        for k in range(FOLDS):
            matrix, right = self._normal(k, columns, precision)
            weights[k, columns, 0] = _solved(matrix, right) if len(columns) else right
        return self._left(weights)[0]

    def _inside(self, selection: Selection) -> tuple[np.ndarray, np.ndarray]:
        """(a,) columns of a selection, and (a,) prior precision of their weights."""
        found: dict[int, float] = {}
        for g, gamma in selection.items():
            if g in self.known:
                continue
            for c in self.study.group(g).columns.tolist():
                found[self.at[c]] = max(found.get(self.at[c], 0.0), gamma)
        columns = np.array(sorted(found), int)
        return columns, np.array([1.0 / found[c] for c in columns.tolist()])

    def _normal(self, k: int, columns: np.ndarray, precision: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Matrix and right side of some columns' weights, from all stretches but those of turn k."""
        matrix = (self.whole - self.gram[k])[np.ix_(columns, columns)]
        matrix[np.diag_indices_from(matrix)] += precision + JITTER * np.diag(matrix)
        return matrix, (self.every - self.right[k])[columns]

    def _left(self, weights: np.ndarray) -> np.ndarray:
        """(b, n) sum of squares of each joint left out [Nm^2] by weights (FOLDS, size, b)."""
        out = np.zeros((weights.shape[2], len(self.parts)))
        for j, (ids, gram, own, total) in enumerate(self.parts):
            for k in range(FOLDS):
                w = weights[k, ids]
                out[:, j] += total[k] - 2.0 * own[k] @ w + np.einsum("ab,ab->b", w, gram[k] @ w)
        return np.maximum(out, 1e-12 * np.array([p[3].sum() for p in self.parts]))

    def without_each(self, selection: Selection, bundles: list[tuple[int, ...]]) -> list[float]:
        """`nepers` of a selection without each of some bundles of its groups, from one inverse a turn.

        With C the inverse and w the weights, leaving out the columns B moves w by -C_.B C_BB^-1 w_B. Bundles that have
        columns in common with what stays are worked out one by one.
        """
        columns, precision = self._inside(selection)
        count = dict.fromkeys(columns.tolist(), 0)
        asked = [g for g in selection if g not in self.known]
        own = {g: [self.at[c] for c in self.study.group(g).columns.tolist()] for g in asked}
        for some in own.values():
            for c in some:
                count[c] += 1
        parts = [np.searchsorted(columns, [c for g in b for c in own[g]]) for b in bundles]
        alone = [all(count[c] == 1 for g in b for c in own[g]) for b in bundles]
        weights = np.zeros((FOLDS, self.size, len(bundles)))
        try:
            for k in range(FOLDS):
                matrix, right = self._normal(k, columns, precision)
                inverse = inverse_of(np.linalg.cholesky(matrix))
                w = inverse @ right
                each = np.repeat(w[:, None], len(bundles), axis=1)
                for i, part in enumerate(parts):
                    if alone[i]:
                        each[:, i] -= inverse[:, part] @ np.linalg.solve(inverse[np.ix_(part, part)], w[part])
                        each[part, i] = 0.0
                weights[k, columns] = each
        except LinAlgError:
            alone = [False] * len(bundles)
        errors = self._left(weights)
        rest = lambda b: {g: v for g, v in selection.items() if g not in b}  # noqa: E731
        return [
            _nepers(errors[i]) + self._surprise(rest(b)) if alone[i] else self.nepers(rest(b))
            for i, b in enumerate(bundles)
        ]

    def total(self, selection: Selection) -> float:
        """Root of the sum of squares over all joints as recorded [Nm]: what is reported as held out."""
        return float(np.sqrt((self.errors(selection) * self.study.state.hypothesis.factors**2).sum()))

    def nepers(self, selection: Selection) -> float:
        """Sum over the joints of the logarithm of the error, and of what another log's own would change by."""
        return _nepers(self.errors(selection)) + self._surprise(selection)

    def _surprise(self, selection: Selection) -> float:
        """Nepers by which that log is explained worse with its values moved as this one asks.

        Half the sum of squares of the moves, in their standard deviations there, over the rows that count.
        """
        prior = [g for g in selection if self.study.label(g).law.certain]
        if not prior:
            return 0.0
        columns, precision = self._inside(selection)
        matrix = self.whole[np.ix_(columns, columns)]
        matrix[np.diag_indices_from(matrix)] += precision + JITTER * np.diag(matrix)
        weights = _solved(matrix, self.every[columns])
        moved = np.isin(columns, [self.at[c] for g in prior for c in self.study.group(g).columns.tolist()])
        return 0.5 * float(weights[moved] @ weights[moved]) / self.counts

    def pruned(self, selection: Selection, stays: Collection[int] = ()) -> Selection:
        """Without the laws that the log is predicted no worse without, the least worthy first.

        Args:
            stays: what is not asked; without friction, factors that were fitted beside it would stand for it.
        """
        now = dict(selection)
        while True:
            fixed = (
                set(self.study.rules.bound(now))
                | self.study.evidence.kept
                | self.known.union(stays)
                | {g for g in now if self._passing(g)}
            )
            worth = self.nepers(now)
            if not np.isfinite(worth):
                return now
            bundles = self._bundles([g for g in now if g not in fixed])
            without = self.without_each(now, bundles)
            trials = [((w - worth) / len(b), b) for w, b in zip(without, bundles, strict=True)]
            if not trials or min(trials)[0] >= WORTH:
                return now
            now = {k: v for k, v in now.items() if k not in min(trials)[1]}

    def _passing(self, g: int) -> bool:
        """True for what was so once and predicts nothing, but would bend all else if it were left out."""
        return not self.study.label(g).law.lasting and not self.study.label(g).law.finding

    def _bundles(self, open_ones: list[int]) -> list[tuple[int, ...]]:
        """Laws one by one, and those of one kind that act on the whole arm together: two events may cancel."""
        kinds: dict[str, list[int]] = {}
        for g in open_ones:
            if self.study.label(g).law.windowed:
                kinds.setdefault(self.study.label(g).law.key, []).append(g)
        return [*((g,) for g in open_ones), *(tuple(some) for some in kinds.values() if len(some) > 1)]


def _fitted(study: Study, groups: Collection[int]) -> np.ndarray:
    """(M, n) torque of some groups of the study's selection [Nm]."""
    found = study.posterior()
    own = np.isin(found.columns, [c for g in groups for c in study.group(g).columns.tolist()])
    return study.design.prediction(found.columns[own], found.weights[own])


def _nepers(errors: np.ndarray) -> float:
    return 0.5 * float(np.log(errors[errors > 0]).sum())


def _solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Weights of a positive matrix; of one that rounding has made indefinite, without the directions it lost."""
    try:
        return cho_solve(cho_factor(matrix, lower=True), right)
    except LinAlgError:
        size = 1.0 / np.sqrt(np.maximum(np.diag(matrix), 1e-300))
        values, vectors = np.linalg.eigh(matrix * size[:, None] * size)
        kept = values > 1e-10 * values[-1]
        along = vectors[:, kept].T @ (size * right)
        return size * (vectors[:, kept] @ (along / values[kept]))
