"""Which laws may be taken beside others, and which cannot be dropped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from app.diagnosis.models.dynamic.library import Candidate, label
from app.diagnosis.regression.evidence import Evidence


class _Known(NamedTuple):
    """What decides whether a group may be taken beside others."""

    name: str
    key: str
    needs: str
    within: str
    exclusive: str
    whole: bool
    closed: bool
    beside: str
    clashes: set[str]


class Rules:
    """Rules of one log.

    Args:
        evidence: holds the groups.
        joints: n.
        without: laws that are not asked.
    """

    def __init__(self, evidence: Evidence, joints: int, without: frozenset[str]):
        self.evidence, self.joints, self.without = evidence, joints, without
        self._known_so_far: list[_Known] = []

    def opens(self, selection: Mapping[int, float], among: Sequence[int] | None = None) -> list[int]:
        """Groups that may be taken, of all or of some: not in, not excluded by one that is, with what they need."""
        groups, known = self.evidence.groups, self._known()
        names = {known[g].name for g in selection}
        loose = [g for g in selection if g not in self.evidence.kept]
        taken = {groups[g].exclusive for g in loose} - {""}
        whole = {known[g].key for g in selection if known[g].whole}
        keys = {known[g].key for g in loose}
        fixed = {known[g].key for g in self.evidence.kept}
        clashing = {k for g in loose for k in known[g].clashes} | whole
        return [
            g for g, k in (enumerate(known) if among is None else ((g, known[g]) for g in among))
            if not k.closed and k.key not in clashing and g not in selection and k.exclusive not in taken
            and (not k.needs or k.needs in names or k.within in whole)
            and (not k.clashes or keys.isdisjoint(k.clashes))
            and (not k.beside or k.beside in whole) and not (k.whole and k.key in fixed)
        ]  # fmt: skip

    def _known(self) -> list[_Known]:
        """What `opens` asks of each group, worked out once."""
        for group in self.evidence.groups[len(self._known_so_far) :]:
            c = label(group)
            self._known_so_far.append(
                _Known(
                    c.name,
                    c.law.key,
                    c.needs,
                    c.law.within,
                    group.exclusive,
                    c.whole,
                    c.law.windowed
                    or self._is_load(c),  # events are offered with their times, and no other way
                    c.law.beside if c.whole else "",
                    self._clashes(c),
                )
            )
        return self._known_so_far

    def _is_load(self, candidate: Candidate) -> bool:
        """True for the last link alone: what is fixed to it is a load on the flange, which says so."""
        last = candidate.place.where.get("link") == self.joints
        load = candidate.law.added
        return bool(load) and last and not candidate.whole and load not in self.without

    def _clashes(self, candidate: Candidate) -> set[str]:
        """Keys of laws that no log tells from this one."""
        arm = not candidate.whole and "joint" not in candidate.place.where
        return set(candidate.law.clashes) if arm else set()

    def bound(self, selection: Mapping[int, float]) -> set[int]:
        """Groups of a selection that another one of it needs."""
        labels = {g: label(self.evidence.groups[g]) for g in selection}
        needed = {c.needs for c in labels.values()} - {""}
        kinds = {c.law.within for c in labels.values() if c.law.within}
        kinds |= {c.law.beside for c in labels.values() if c.whole and c.law.beside}
        return {g for g, c in labels.items() if c.name in needed or (c.whole and c.law.key in kinds)}
