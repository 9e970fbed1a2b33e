"""Error on folds left out, from Gram matrices: nothing is fitted row by row."""

from __future__ import annotations

import numpy as np

from app.diagnosis.regression.design import Absorbed

#: Folds poses are dealt into, in turn.
FOLDS = 8


def folds_of(pose: np.ndarray) -> np.ndarray:
    """(m,) fold of each row: poses dealt out in turn, repeats of one pose together.

    Args:
        pose: (m,) number of the pose.
    """
    order = np.unique(pose, return_index=True)[1]
    rank = np.empty(len(order), int)
    rank[np.argsort(order, kind="stable")] = np.arange(len(order))
    return rank[pose] % FOLDS


def heldout_residuals(
    columns: np.ndarray,
    response: np.ndarray,
    precision: np.ndarray,
    fold: np.ndarray,
    prefixes: list[int],
    absorbed: Absorbed | None = None,
) -> list[np.ndarray]:
    """Errors of each value when its fold is predicted from the others, for models of the first columns only.

    Args:
        columns: (N, p) whitened, what is free first.
        response: (N,) whitened.
        precision: (p,) prior precision of each weight; 0 where it is free.
        fold: (N,) number of the fold.
        prefixes: numbers of columns of the models, rising.
        absorbed: free parameters by groups of rows.

    Returns:
        (N,) one a prefix; NaN where the other folds never saw an absorbed parameter.
    """
    norm = np.sqrt(np.einsum("np,np->p", columns, columns))
    norm = np.where(norm > 0, norm, 1.0)
    both = np.column_stack([columns / norm, response])
    prior = np.append(precision / norm**2, 0.0)
    out = [np.full(len(response), np.nan) for _ in prefixes]
    gram = both.T @ both
    groups = None if absorbed is None else _Groups(absorbed, both)
    for f in np.unique(fold):
        test = fold == f
        block, known = both[test], np.ones(int(test.sum()), bool)
        left = gram - block.T @ block
        if groups is not None:
            left, block, known = groups.without(test, left, block)
        # a tiny ridge: directions that the other folds hardly saw are not blown up
        left[np.diag_indices_from(left)] += prior + 1e-9
        for i, count in enumerate(prefixes):
            weights = np.linalg.solve(left[:count, :count], left[:count, -1])
            out[i][test] = np.where(known, block[:, -1] - block[:, :count] @ weights, np.nan)
    return out


class _Groups:
    """Absorbed parameters by their sums over rows, from which any fold can be taken out."""

    def __init__(self, absorbed: Absorbed, both: np.ndarray):
        self.absorbed = absorbed
        self.count = int(absorbed.label.max()) + 1
        self.weighted = both * absorbed.entry[:, None]
        self.sums = self._summed(np.ones(len(both), bool))
        self.norm = np.bincount(absorbed.label, absorbed.entry**2, self.count)

    def _summed(self, rows: np.ndarray) -> np.ndarray:
        out = np.zeros((self.count, self.weighted.shape[1]))
        np.add.at(out, self.absorbed.label[rows], self.weighted[rows])
        return out

    def without(self, test: np.ndarray, left: np.ndarray, block: np.ndarray):
        """Gram matrix of the other folds with the parameters projected off, the fold's rows less what they say of
        them, and which of those rows they say anything of."""
        label, entry = self.absorbed.label[test], self.absorbed.entry[test]
        sums = self.sums - self._summed(test)
        norm = self.norm - np.bincount(label, entry**2, self.count)
        seen = norm > 1e-12 * max(float(self.norm.max()), 1e-300)
        mean = sums / np.where(seen, norm, np.inf)[:, None]
        return left - sums.T @ mean, block - entry[:, None] * mean[label], seen[label]
