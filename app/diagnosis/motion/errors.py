"""Torque residuals and held-out errors [Nm] of the final model and of parts of it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from types import MappingProxyType

import numpy as np

from app.diagnosis.motion.heldout import FOLDS, folds, solved
from app.diagnosis.motion.system import Group, System
from app.kinematics.dynamics import PER_LINK


class ErrorTable:
    """The final model with any of its terms left out, the rest refitted.

    Fold sums are assembled once; leaving a term out is leaving out its rows and columns.
    """

    def __init__(
        self,
        system: System,
        prior: np.ndarray,
        selected: list[Group],
        response: np.ndarray,
        done: Mapping[int, np.ndarray] = MappingProxyType({}),
    ):
        """Args:
        prior: information on the leading unknowns.
        response: (M, n) what the linear model is fitted to [Nm].
        done: term -> what the response was corrected by, in the term's columns; put back here.
        """
        self.system, self.prior, self.selected, self.response = system, prior, selected, response
        self.all = system.normal(selected)[:2]
        self._left_out = folds(system.block_count)[:FOLDS]
        A, g, _ = system.normal_folds(selected, self._left_out)
        self._rest = self.all[0] - A, self.all[1] - g  # what each fold leaves
        self.raw = raw_columns(system, selected)
        _, self.positions, _ = system.layout(selected)
        self._put_back(done)
        self._memory: dict[tuple[int, ...], float] = {}

    def _put_back(self, done: Mapping[int, np.ndarray]) -> None:
        _, _, size = self.system.layout(self.selected)
        back, at = np.zeros(size), size - sum(g.size for g in self.selected)
        for i, group in enumerate(self.selected):
            if i in done:
                back[at : at + group.size] = done[i]
            at += group.size
        if not back.any():
            return
        self.all = (self.all[0], self.all[1] + self.all[0] @ back)
        self._rest = self._rest[0], self._rest[1] + self._rest[0] @ back
        self.response = self.response.copy()
        for j, (columns, pos) in enumerate(zip(self.raw, self.positions, strict=True)):
            self.response[:, j] += columns @ back[pos]

    def _keep(self, terms: list[int]) -> np.ndarray:
        nuisance = len(self.all[1]) - sum(g.size for g in self.selected)
        index, at = [np.arange(nuisance)], nuisance
        for i, group in enumerate(self.selected):
            if i in terms:
                index.append(np.arange(at, at + group.size))
            at += group.size
        return np.concatenate(index)

    def _theta(self, A: np.ndarray, g: np.ndarray, keep: np.ndarray) -> np.ndarray:
        out = np.zeros_like(g)
        out[..., keep] = solved(A[..., keep[:, None], keep], g[..., keep], self.prior)
        return out

    def theta_with(self, terms: list[int]) -> np.ndarray:
        """(p,) all unknowns, those of terms that are left out being zero."""
        return self._theta(*self.all, self._keep(terms))

    def residual(self, terms: list[int]) -> np.ndarray:
        """(M, n) [Nm] with only these terms in the model."""
        theta = self.theta_with(terms)
        out = self.response.copy()
        for j, (columns, pos) in enumerate(zip(self.raw, self.positions, strict=True)):
            out[:, j] -= columns @ theta[pos]
        return out

    def heldout(self, terms: list[int]) -> float:
        """Root mean square [Nm] on blocks left out, every fifth one in turn."""
        key = tuple(terms)
        if key not in self._memory:
            self._memory[key] = float(np.sqrt(np.mean(self.heldout_joints(terms) ** 2)))
        return self._memory[key]

    def heldout_joints(self, terms: list[int]) -> np.ndarray:
        """(n,) [Nm] the same, joint by joint."""
        total, count = np.zeros((2, self.system.joints))
        A, g = self._rest
        for theta, seen in zip(self._theta(A, g, self._keep(terms)), self._folded, strict=True):
            for j, (response, columns) in enumerate(seen):
                left = response - columns @ theta[self.positions[j]]
                total[j] += left @ left
                count[j] += len(left)
        return np.sqrt(total / np.maximum(count, 1))

    @cached_property
    def _folded(self) -> list[list[tuple[np.ndarray, np.ndarray]]]:
        """Per fold and joint, response (r,) and columns (r, p) of the rows that the fold leaves out."""
        blocks, usable = self.system.samples.blocks, self.system.samples.usable
        out = []
        for left_out in self._left_out:
            good = left_out[blocks][:, None] & usable
            out.append([(self.response[good[:, j], j], c[good[:, j]]) for j, c in enumerate(self.raw)])
        return out


def raw_columns(system: System, selected: list[Group]) -> list[np.ndarray]:
    """Per joint, the columns of a model before whitening, in the order of `System.layout`."""
    samples = system.samples
    out = []
    for j in range(system.joints):
        pieces = [samples.regressor[:, PER_LINK * j :, j]]
        for group in selected:
            if group.joint is None or group.joint == j:
                columns = system.raw[group]
                pieces.append(columns[:, j] if group.joint is None else columns)
        out.append(np.concatenate(pieces, axis=1))
    return out
