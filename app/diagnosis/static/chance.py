"""What chance would do: the library held against residuals with their signs flipped, by pose and by stretch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.library import Candidate, library
from app.diagnosis.static.looking import score_all, with_ghosts
from app.diagnosis.static.score import Scores, basis
from app.diagnosis.static.serial import stretch, stretch_flips


@dataclass(frozen=True, eq=False)
class Chance:
    """Everything a search needs to tell an effect from luck.

    Args:
        wanted: the library.
        rng: of the flips by stretch.
        signs: (m, f) flips by pose.
        level: a term is taken only where chance would do as well in at most this share of searches.
    """

    wanted: tuple[Candidate, ...]
    rng: np.random.Generator
    signs: np.ndarray
    level: float

    def scores(self, fitted: Fitted) -> Scores:
        """The whole library on what a fit leaves, and the null."""
        return self._scored(fitted, self.signs)

    def in_stretches(self, trial: Fitted) -> np.ndarray | None:
        """The null where errors come in stretches of time, from what the trial leaves; None where they do not."""
        length = stretch(trial)
        if length == 1:
            return None
        pose = with_ghosts(trial.recording.pose, trial.ghosts)
        return self._scored(trial, stretch_flips(self.rng, pose, self.signs.shape[1], length)).null

    def _scored(self, fitted: Fitted, signs: np.ndarray) -> Scores:
        lib = library(fitted.columns, self.wanted, fitted.ghosts)
        return score_all(fitted, lib, basis(fitted.jacobian), signs)
