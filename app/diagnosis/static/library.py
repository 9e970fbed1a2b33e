"""Every effect at every place as one matrix of columns."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from app import catalog
from app.diagnosis.static.effect import Place, StaticEffect
from app.diagnosis.static.sensitivity import Sensitivity
from app.diagnosis.static.situation import Situation

EFFECTS = "app.diagnosis.effects.static"
#: Effects that restate the geometry of the description.
GEOMETRY = ("joint_zero", "link_length", "link_twist")


@cache
def effects() -> dict[str, StaticEffect]:
    """All static effects by key."""
    return catalog.members(EFFECTS, "EFFECT")


@dataclass(frozen=True)
class Candidate:
    """One effect at one place (its starting row still open where `place.scan`)."""

    effect: StaticEffect
    place: Place

    @property
    def label(self) -> tuple:
        return (self.effect.key, *sorted(self.place.where.items()), *sorted(self.place.fixed.items()))


@dataclass(frozen=True, eq=False)
class Library:
    """Candidates with their columns.

    Args:
        candidates: those without a starting row.
        matrix: (N, g) their columns side by side, whitened.
        starts: (len(candidates) + 1,) first column of each.
        onesided: True for those of one parameter that cannot be negative.
        scans: candidates with a starting row to be searched for, and their unmasked columns (m, k, d).
    """

    candidates: tuple[Candidate, ...]
    matrix: np.ndarray
    starts: np.ndarray
    onesided: np.ndarray
    scans: tuple[tuple[Candidate, np.ndarray], ...]

    def block(self, index: int) -> np.ndarray:
        return self.matrix[:, self.starts[index] : self.starts[index + 1]]


def candidates(situation: Situation, without: frozenset[str] = frozenset()) -> tuple[Candidate, ...]:
    """Every effect at every place it can sit on this arm."""
    return tuple(
        Candidate(effect, place)
        for key, effect in effects().items()
        if key not in without
        for place in effect.places(situation)
    )


def library(columns: Sensitivity, wanted: tuple[Candidate, ...], ghosts: int = 0) -> Library:
    """Their columns at the present state of the cell; zeros in the ghost rows behind the recorded ones."""
    m, k = columns.weights.shape
    fixed, blocks, scans = [], [], []
    for candidate in wanted:
        block = candidate.effect.columns(columns, candidate.place)
        if ghosts:
            block = np.concatenate([block, np.zeros((ghosts, *block.shape[1:]))])
        if candidate.place.scan:
            scans.append((candidate, block))
        else:
            fixed.append(candidate)
            blocks.append(block)
    starts = np.concatenate([[0], np.cumsum([b.shape[2] for b in blocks])]).astype(int)
    matrix = (
        np.concatenate(blocks, axis=2).reshape((m + ghosts) * k, -1)
        if blocks
        else np.zeros(((m + ghosts) * k, 0))
    )
    onesided = np.array([_onesided(columns.situation, c) for c in fixed], bool)
    return Library(tuple(fixed), matrix, starts, onesided, tuple(scans))


def _onesided(situation: Situation, candidate: Candidate) -> bool:
    quantities = candidate.effect.quantities(situation, candidate.place)
    return len(quantities) == 1 and quantities[0].lower >= 0.0
