"""The order of the search: few effects on a sound description first; where that does not stand, an arm as built,
or structure without a name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.result import Leftover
from app.diagnosis.static.as_built import evidence, fit_as_built, relearnt
from app.diagnosis.static.doubts import Doubt, doubt_of, leftover_doubt, stand_in
from app.diagnosis.static.fit import Fitted, fit
from app.diagnosis.static.leftover import LEVEL, leftover_of
from app.diagnosis.static.library import GEOMETRY, Candidate, candidates
from app.diagnosis.static.noise import position_rms, weights_from
from app.diagnosis.static.search import Found, forward
from app.diagnosis.static.shape import SHARE, law_gain

#: So many findings on one arm are a sign that all its geometry is off.
MANY = 3
_MOST_CURVES = 3
#: Share of what can be explained at all that one law must explain to carry the picture.
CARRIES = 0.9


@dataclass(frozen=True, eq=False)
class Plan:
    """A search's outcome with what was looked at before its names are given.

    Args:
        found: terms and their p.
        leftover: what is left, or what a withheld name stood for.
        withheld: places whose structure got no name.
        doubt: what should be replaced by a free curve next, or None.
        as_built: True where all geometry was fitted alongside.
    """

    found: Found
    leftover: Leftover
    withheld: tuple[Doubt, ...]
    doubt: Doubt | None
    as_built: bool

    @property
    def p_values(self) -> dict[tuple, float]:
        """Family-wise, by the term's label."""
        named = [t for t in self.found.fitted.terms if not t.tacit]
        return {t.label: p for t, p in zip(named, self.found.p_values, strict=False)}

    @property
    def shadows(self) -> frozenset[tuple]:
        """Labels of findings that sit where structure without a name remains: they may be its shadow.

        Not so where that structure is small beside what the finding explains.
        """
        fitted, joints = self.found.fitted, {d.where.get("joint") for d in self.withheld} - {None}
        out = set()
        for index, term in enumerate(fitted.terms):
            joint = term.where.get("joint")
            if term.tacit or joint is None:
                continue
            remains = self.doubt is not None and self.doubt.where.get("joint") == joint
            if joint in joints or (remains and not self._slight(index)):
                out.add(term.label)
        return frozenset(out)

    def _slight(self, index: int) -> bool:
        """True where all that remains, noise included, is next to nothing beside what term `index` explains."""
        fitted = self.found.fitted
        return fitted.rss < SHARE * law_gain(fitted, index)

    @property
    def sound(self) -> bool:
        return self.doubt is None and self.leftover.p_value > LEVEL

    def evidence(self, choices: int) -> float:
        """To be compared between pictures; a named law was chosen among as many, which counts against it.

        Source: the extended BIC (Chen and Chen 2008) with gamma 0.5.
        """
        named = sum(not term.tacit for term in self.found.fitted.terms)
        return evidence(self.found.fitted) + named * float(np.log(max(choices, 1)))


Tick = Callable[[float, str], None]


def explore(before: Fitted, rng: np.random.Generator, tick: Tick) -> Plan:
    """Searches, checks the names' curves and what is left, and tries other pictures where they do not stand."""
    wanted = candidates(before.recording.situation)
    first = _searched(before, wanted, rng, tick)
    named = [t for t in first.found.fitted.terms if not t.tacit]
    if first.sound and len(named) < MANY:
        return first
    tick(0.4, "fitting all geometry")
    physical = tuple(c for c in wanted if c.effect.key not in GEOMETRY)
    built = _searched(fit_as_built(before), physical, rng, tick, as_built=True)
    if carried(first, built, before):
        return first
    tick(0.6, "looking for what has no name")
    curved = _with_curves(first, before, wanted, rng, tick)
    pictures = (curved, built) if first.doubt is not None else (first, curved, built)

    def unlikely(plan: Plan) -> float:
        return plan.evidence(len(wanted))

    best = min(pictures, key=unlikely)
    if best is built and not built.sound:
        # With free curves in, an arm as built may fit worse than the sound description did with them.
        again = _with_curves(built, fit_as_built(before), physical, rng, tick)
        best = min((again, curved), key=unlikely)
    return best


def carried(first: Plan, built: Plan, before: Fitted) -> bool:
    """True where one law on the sound description does nearly all that an arm with all its geometry off could do.

    What remains then is small beside that law: it is said as left over, and does not take the law's name away.
    """
    if doubt_of(first.found.fitted) is not None:
        return False
    start = position_rms(before) ** 2
    most = start - position_rms(built.found.fitted) ** 2
    for term in first.found.fitted.terms:
        if term.tacit or term.effect.key in GEOMETRY:
            continue
        alone = fit(before.recording, before.setup, (*before.terms, term), before.weights, held=before.held)
        if start - position_rms(alone) ** 2 > CARRIES * most:
            return True
    return False


def _searched(
    start: Fitted, wanted: tuple[Candidate, ...], rng, tick: Tick, as_built: bool = False, withheld=()
) -> Plan:
    """One forward search with its checks."""
    found = forward(start, wanted, rng, tick=tick)
    if as_built and found.p_values:
        found = replace(found, fitted=relearnt(found.fitted, 2))
    doubt = doubt_of(found.fitted)
    left = leftover_of(found.fitted, rng)
    if doubt is None and left.p_value <= LEVEL:
        doubt = leftover_doubt(left.where)
    return Plan(found, left, tuple(withheld), doubt, as_built)


def _with_curves(plan: Plan, start: Fitted, wanted: tuple[Candidate, ...], rng, tick: Tick) -> Plan:
    """Puts free curves in for what has no name, until the names that remain stand."""
    base, withheld = start, list(plan.withheld)
    for _ in range(_MOST_CURVES):
        if plan.doubt is None:
            break
        curve = stand_in(base, plan.doubt)
        if curve is None:
            break
        withheld.append(plan.doubt)
        base = fit(base.recording, base.setup, (*base.terms, curve), base.weights, held=base.held)
        base = fit(base.recording, base.setup, base.terms, weights_from(base), held=base.held)
        plan = _searched(base, wanted, rng, tick, plan.as_built, withheld)
    return plan
