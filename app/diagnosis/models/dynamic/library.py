"""All laws at all places of a log, as groups of columns; renewed where a column follows what is fitted."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from app import catalog
from app.diagnosis.effects.effect import Place
from app.diagnosis.regression.evidence import Group
from app.diagnosis.thresholds.evidence import FAMILY_WIDTHS, LAW_WIDTHS, LOG_FAMILY

if TYPE_CHECKING:
    from app.diagnosis.effects.dynamic._law import Law
    from app.diagnosis.models.dynamic.design import TorqueDesign
    from app.diagnosis.models.dynamic.state import State


EFFECTS = "app.diagnosis.effects.dynamic"
NOTHING: Mapping[str, float] = MappingProxyType({})
#: What members need that are never taken but with their family: no group is called so.
FAMILY_ONLY = "*"


@dataclass(frozen=True, eq=False)
class Candidate:
    """A law at a place, or all links at once.

    Args:
        needs: label of the group that must be in before this one is asked.
    """

    law: Law
    place: Place
    needs: str = ""
    whole: bool = False

    @property
    def held(self) -> bool:
        """True where the log is read without it before anything is fitted; a family of small ones is fitted."""
        return self.law.undone and not self.whole and self.place.alone

    @property
    def identity(self) -> tuple[str, int]:
        """Key and joint of a law that is undone, 0 for the whole arm; of others empty."""
        return (self.law.key, int(self.place.where.get("joint", 0))) if self.held else ("", 0)

    @property
    def seat(self) -> tuple:
        """Law, where, and the form; what a hypothesis holds already is no part of it."""
        fixed = self.place.fixed
        form = sorted((k, v) for k, v in fixed.items() if not k.startswith("fixed_"))
        where = sorted(self.place.where.items())
        return self.law.key, self.whole, tuple(where), tuple(form), fixed.get("fixed_sense")

    def fresh(self, state: State) -> Place:
        """The place; of a law that is undone with what the hypothesis now holds of it."""
        if self.law.undone:
            for place in self.law.places(state):
                if place.where == self.place.where:
                    return place
        return self.place

    @property
    def name(self) -> str:
        return f"{self.law.key} {self.place.where.get('joint', self.place.where.get('link', ''))}".rstrip()


def label(group: Group) -> Candidate:
    """What a group is."""
    assert isinstance(group.label, Candidate)
    return group.label


def laws() -> dict[str, Law]:
    """Every law, by key."""
    return catalog.members(EFFECTS, "EFFECT")


def build(
    design: TorqueDesign,
    state: State,
    *,
    without: frozenset[str] = frozenset(),
    stretch: Mapping[str, float] = NOTHING,
    single: frozenset[str] = frozenset(),
) -> list[Group]:
    """Groups for every law at every place that is not searched for in time.

    Args:
        without: keys left out.
        stretch: key of a law -> how far its values may be off, over their nominal widths.
        single: keys of laws that are asked at one place at a time, and not of all places as a family; they are never in
            beside each other or a load: it was put on or taken off at one place.
    """
    chosen: list[tuple[Candidate, Law]] = []
    for key, law in sorted(laws().items()):
        if key in without:
            continue
        for place in law.places(state):
            if not place.scan:
                needs = f"{law.within} {place.where['joint']}" if law.within else ""
                needs = needs if place.alone else FAMILY_ONLY
                chosen.append((Candidate(law, place, needs), law))
    blocks = [(law.block(state, c.place), stretch.get(law.key, 1.0)) for c, law in chosen]
    numbers = design.add([(found, widths * s) for (found, widths), s in blocks])
    groups = [group_of(candidate, own) for (candidate, _), own in zip(chosen, numbers, strict=True)]
    if single:
        alone = [c.law.key in single or c.law.family == "load" for c, _ in chosen]
        groups = [replace(g, exclusive="load") if one else g for g, one in zip(groups, alone, strict=True)]
    for law in {c.law.key: c.law for c, _ in chosen if c.law.whole and c.law.key not in single}.values():
        members = [
            own for (c, _), own in zip(chosen, numbers, strict=True) if c.law is law and c.place.member
        ]
        if len(members) > 1:
            every = Candidate(law, Place({}), whole=True)
            widths = np.array(law.spread) if law.spread else FAMILY_WIDTHS
            groups.append(Group(np.concatenate(members), LOG_FAMILY, widths=widths, label=every))
    return groups


def nominal(group: Group) -> float:
    """The variance of a group, over that of its nominal widths, that is nearest to one."""
    return float(np.clip(1.0, group.widths.min(), group.widths.max()))


def group_of(candidate: Candidate, columns: np.ndarray) -> Group:
    """A law at a place as a group of its own."""
    law, place = candidate.law, candidate.place
    joint = place.where.get("joint", place.where.get("link", ""))
    exclusive = f"{law.key} {joint}" if law.bent and not law.series else ""
    if law.contains or any(other.contains == law.key for other in laws().values()):
        exclusive = f"{law.contains or law.key} {joint}"
    widths = LAW_WIDTHS[:1] if law.certain else LAW_WIDTHS
    return Group(columns, law.penalty + place.cost, widths=widths, label=candidate, exclusive=exclusive)
