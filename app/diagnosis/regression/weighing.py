"""What groups of columns add to the evidence at the best of some widths, from what is left of their products.

With G what is left of a group's Gram matrix, h of its X'y and R the residual beside a selection, a width gamma takes
h' (G + I / gamma)^-1 h of R and costs 1/2 ln |I + gamma G|.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from app.diagnosis.regression.solved import Statistics

#: Widths up to which each has a factor of its own: an eigenbasis for all of them takes as long as ten.
FEW_WIDTHS = 8


class Weighing:
    """How residuals count, and what groups are worth by that.

    Args:
        unit_noise: True where the whitened noise has unit variance for sure.
    """

    def __init__(self, statistics: Statistics, *, unit_noise: bool):
        self.statistics, self.unit_noise = statistics, unit_noise

    def fit(self, residual: np.ndarray | float, total: np.ndarray | float) -> np.ndarray | float:
        """Log likelihood beyond that of a residual `total`."""
        if self.unit_noise:
            return 0.5 * (total - residual)
        return -0.5 * self.statistics.dof * np.log(residual / total)

    def best_width(self, values, squares, residual: float, cap, penalty, widths: np.ndarray, expected=None):
        """Gains and gammas of a batch in eigenbases: values, squares (b, d); cap, penalty (b,); expected None or (w,),
        the log density of each width."""
        gamma = widths[:, None, None]
        stretch = 1.0 + gamma * values
        taken = squares * gamma / stretch
        if values.shape[1] == 1:
            taken, logs = taken[:, :, 0], np.log(stretch[:, :, 0])
        else:
            taken, logs = taken.sum(axis=2), np.log(stretch).sum(axis=2)
        return self.widest(taken, logs, residual, cap, penalty, widths, expected)

    def best_width_of_blocks(
        self, block, own, residual: float, cap, penalty, widths: np.ndarray, expected=None
    ):
        """The same of Gram matrices block (b, d, d) and right-hand sides own (b, d)."""
        if len(widths) > FEW_WIDTHS:
            values, vectors = np.linalg.eigh(block)
            squares = (own[:, None, :] @ vectors)[:, 0] ** 2
            return self.best_width(np.maximum(values, 0.0), squares, residual, cap, penalty, widths, expected)
        taken, logs = np.empty((len(widths), len(block))), np.empty((len(widths), len(block)))
        eye, d = np.eye(block.shape[1]), block.shape[1]
        rounding = 1e-15 * np.trace(block, axis1=1, axis2=2)[:, None, None]
        for k, gamma in enumerate(widths.tolist()):
            inner = block + (1.0 / gamma + rounding) * eye
            taken[k] = np.einsum("bd,bd->b", own, np.linalg.solve(inner, own[..., None])[..., 0])
            logs[k] = np.linalg.slogdet(inner)[1] + d * np.log(gamma)
        return self.widest(taken, logs, residual, cap, penalty, widths, expected)

    def widest(self, taken, logs, residual: float, cap, penalty, widths: np.ndarray, expected):
        """Gains and gammas from what each width takes of the residual and from ln |I + gamma G|, (w, b) each."""
        left = np.maximum(residual - taken, 1e-9 * residual)  # (w, b)
        gain = self.fit(left, residual) - 0.5 * logs
        # gamma counts in variances of the noise that is left once the group is in
        variance = 1.0 if self.unit_noise else left / self.statistics.dof
        gain = np.where(widths[:, None] * variance > np.asarray(cap) ** 2, -np.inf, gain)
        if expected is not None:
            gain = gain + expected[:, None]
        gain[0] = np.where(np.isneginf(gain).all(axis=0), -1e9, gain[0])
        best = gain.argmax(axis=0)
        return gain[best, np.arange(len(best))] - penalty, widths[best]

    def most(self, gram: np.ndarray, right: np.ndarray, residual: float, widths: np.ndarray) -> np.ndarray:
        """(...,) what groups could bring at most, whatever their width and its price.

        Args:
            gram: (..., d, d) of what is left of their columns.
            right: (..., d) of those and what is left of the response.
        """
        wide, d = 1.0 / float(widths[-1]), gram.shape[-1]
        if d == 1:
            taken = right[..., 0] ** 2 / (np.maximum(gram[..., 0, 0], 0.0) + wide)
        else:
            rounding = wide + 1e-12 * np.trace(gram, axis1=-2, axis2=-1)[..., None, None]
            taken = np.sum(
                right * np.linalg.solve(gram + rounding * np.eye(d), right[..., None])[..., 0], axis=-1
            )
        left = residual - taken
        return np.asarray(self.fit(np.maximum(left, 1e-9 * residual), residual))
