"""Effects with values, and the cell they make."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from app import catalog
from app.diagnosis.models.kinematic.cell import Cell, nominal_cell
from app.diagnosis.thresholds.drivers import BEYOND, INSIDE

if TYPE_CHECKING:
    from app.diagnosis.effects.effect import Effect, Place
    from app.diagnosis.models.kinematic.situation import Situation


EFFECTS = "app.diagnosis.effects.kinematic"


@cache
def effects() -> dict[str, Effect]:
    """All effects on tool points by key."""
    return catalog.members(EFFECTS, "EFFECT")


@dataclass(frozen=True, eq=False)
class Term:
    """An effect at a place with values.

    Args:
        values: (d,) SI, in the order of the effect's quantities.
        named: False for what belongs to the fit without being a finding.
        reach: (2, n) lowest and highest joint positions between which it was learnt and holds. None: a
            law, which holds everywhere.
        near: True where it holds only among poses like those it was learnt at.
    """

    effect: Effect
    place: Place
    values: np.ndarray
    named: bool = False
    reach: np.ndarray | None = None
    near: bool = False

    @property
    def where(self) -> Mapping[str, Any]:
        return self.place.where

    @property
    def label(self) -> tuple:
        """Hashable identity: key and place."""
        return label_of(self.effect, self.place)


def label_of(effect: Effect, place: Place) -> tuple:
    """Hashable identity of an effect at a place."""
    return (effect.key, *sorted(place.where.items()), *sorted(place.fixed.items()))


def apply_terms(situation: Situation, terms: tuple[Term, ...]) -> Cell:
    """The cell with all these effects in it.

    Parts that hold only where they were learnt are left out of rows that go elsewhere: of all rows, because base and
    tool are fitted to them together, and would bend to a part that is in some and not in others.
    """
    cell = nominal_cell(situation)
    together: dict[tuple, Term] = {}  # parts of one law are linear in their values
    for term in terms:
        if term.reach is None or _reached(situation, term.reach):
            same = together.get(term.label)
            values = term.values if same is None else same.values + term.values
            together[term.label] = replace(term, values=values)
    for term in together.values():
        cell = term.effect.apply(cell, situation, term.place, term.values)
    return cell


def _reached(situation: Situation, reach: np.ndarray) -> bool:
    """Whether these rows stay where something was learnt, reach (2, n)."""
    key = ("reached", reach.tobytes())
    if key not in situation.kept:
        inside = np.all((situation.q >= reach[0] - BEYOND) & (situation.q <= reach[1] + BEYOND), axis=1)
        situation.kept[key] = bool(inside.mean() >= INSIDE)
    return situation.kept[key]
