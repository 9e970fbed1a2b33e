"""Every effect at every place that it can sit at on an arm: what may be in a description of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from app.diagnosis.effects.effect import Effect, Place
from app.diagnosis.models.kinematic.situation import Situation
from app.diagnosis.models.kinematic.terms import effects, label_of


@dataclass(frozen=True, eq=False)
class Candidate:
    """An effect at a place.

    Args:
        widths: (d,) nominal sizes, SI.
        label: hashable identity.
        positive: True for a single quantity that cannot be negative.
    """

    effect: Effect
    place: Place
    widths: np.ndarray
    label: tuple
    positive: bool


def candidate_of(effect: Effect, place: Place, situation: Situation) -> Candidate:
    """An effect at a place of a situation."""
    quantities = effect.quantities(situation, place)
    positive = len(quantities) == 1 and quantities[0].lower >= 0.0
    return Candidate(effect, place, effect.widths(situation, place), label_of(effect, place), positive)


@dataclass(eq=False)
class Library:
    """All candidates; changes at rows join as they are found.

    Args:
        situation: the drivers.
        fixed: candidates with their own columns.
        scanned: candidates whose first row is searched for.
    """

    situation: Situation
    fixed: list[Candidate]
    scanned: list[Candidate]
    labels: dict[tuple, int] = field(default_factory=dict)

    def number_of(self, candidate: Candidate) -> int:
        """Its number; a new one (a change at a row) joins."""
        label = candidate.label
        if label not in self.labels:
            self.labels[label] = len(self.fixed)
            self.fixed.append(candidate)
        return self.labels[label]

    def at_row(self, scanned: Candidate, row: int) -> Candidate:
        """A scanned candidate with its first row."""
        place = scanned.place.at(from_row=int(row))
        return replace(scanned, place=place, label=label_of(scanned.effect, place))


def library_of(situation: Situation) -> Library:
    """Every effect at every place it can sit on this arm; worked out once for a recording."""
    key = ("library", tuple(effects()))
    if key not in situation.kept:
        every = [
            candidate_of(e, place, situation) for e in effects().values() for place in e.places(situation)
        ]
        situation.kept[key] = every
    every: list[Candidate] = situation.kept[key]
    fixed = [c for c in every if not c.place.scan]
    scanned = [c for c in every if c.place.scan]
    return Library(situation, fixed, scanned, {c.label: i for i, c in enumerate(fixed)})
