"""The order of the search: few effects on a sound description first; an arm as built only where that fails."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.result import Leftover
from app.diagnosis.static.as_built import evidence, fit_as_built, relearnt
from app.diagnosis.static.curves import JOINT_CURVE, joint_curve_place, shape_functions
from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.leftover import LEVEL, leftover_of
from app.diagnosis.static.library import GEOMETRY, Candidate, candidates
from app.diagnosis.static.noise import weights_from
from app.diagnosis.static.search import Found, forward
from app.diagnosis.static.shape import LEVEL as SHAPE_LEVEL
from app.diagnosis.static.shape import curve_p_value

#: So many geometric findings on one arm are a sign that all its geometry is off.
MANY = 3


@dataclass(frozen=True, eq=False)
class Plan:
    """A search's outcome with what was looked at before its names are given.

    Args:
        found: terms and their p.
        leftover: what is left, or what a withheld name stood for.
        withheld: places whose name was not given.
        as_built: True where all geometry was fitted alongside.
    """

    found: Found
    leftover: Leftover
    withheld: tuple[dict, ...]
    as_built: bool


def explore(before: Fitted, rng: np.random.Generator, tick) -> Plan:
    """Searches, checks the names' curves and what is left, and tries the arm as built where need be."""
    wanted = candidates(before.recording.situation)
    plan = _checked(before, wanted, rng, tick)
    named = [t for t in plan.found.fitted.terms if not t.tacit]
    geometric = sum(t.effect.key in GEOMETRY for t in named)
    if plan.leftover.p_value > LEVEL and not plan.withheld and geometric < MANY:
        return plan
    tick(0.5, "fitting all geometry")
    built = fit_as_built(before)
    physical = tuple(c for c in wanted if c.effect.key not in GEOMETRY)
    second = _checked(built, physical, rng, tick, as_built=True)
    if evidence(second.found.fitted) < evidence(plan.found.fitted):
        return second
    return plan


def _checked(start: Fitted, wanted: tuple[Candidate, ...], rng, tick, as_built: bool = False) -> Plan:
    """Forward search; names whose curve is not theirs are replaced by a free curve, and the search repeated."""
    withheld: list[dict] = []
    base = start
    for _ in range(3):
        found = forward(base, wanted, rng, tick=tick)
        if as_built and any(not t.tacit for t in found.fitted.terms):
            found = replace(found, fitted=relearnt(found.fitted, 2))
        doubtful = _doubtful(found.fitted)
        if doubtful is None:
            break
        term = found.fitted.terms[doubtful]
        if "joint" not in term.where:
            withheld.append(dict(term.where))
            break
        curve = _stand_in(base, term)
        if curve is None:
            break
        withheld.append({k: v for k, v in term.where.items() if k != "from_row"})
        base = fit(base.recording, base.setup, (*base.terms, curve), base.weights, held=base.held)
        base = fit(base.recording, base.setup, base.terms, weights_from(base), held=base.held)
    left = leftover_of(found.fitted, rng)
    if withheld:
        left = Leftover(min(left.p_value, SHAPE_LEVEL), withheld[0])
    return Plan(found, left, tuple(withheld), as_built)


def _doubtful(fitted: Fitted) -> int | None:
    """The term whose law a free curve of its driver beats most clearly, or None."""
    worst, at = SHAPE_LEVEL, None
    for index, term in enumerate(fitted.terms):
        if term.tacit:
            continue
        p_value = curve_p_value(fitted, index)
        if p_value < worst:
            worst, at = p_value, index
    return at


def _stand_in(base: Fitted, term: Term) -> Term | None:
    """The free curve for a term, or None where its driver has none or it is in already."""
    curve = term.effect.curve
    where = {k: v for k, v in term.where.items() if k != "from_row"}
    if curve is None:
        curve = "pace" if "from_row" in term.where else "own_angle"
    place = joint_curve_place(where, curve)
    if any(t.effect is JOINT_CURVE and t.place == place for t in base.terms):
        return None
    count = shape_functions(base.recording.situation, where, curve).shape[1]
    return Term(JOINT_CURVE, place, np.zeros(count), tacit=True) if count else None
