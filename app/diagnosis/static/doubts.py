"""Which names may not be given, and what stands in for them: a free curve at the same place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.diagnosis.static.curves import JOINT_CURVE, joint_curve_place, shape_functions
from app.diagnosis.static.fit import Fitted, Term
from app.diagnosis.static.outsiders import COMBINED, FAMILIES, MARGIN, best_outsider, outsider_advantage
from app.diagnosis.static.shape import LEVEL, SHARE, curve_p_value, dominant, law_gain

#: Effect -> family of laws outside the library that could be taken for it.
_FAMILY = {
    "joint_zero": "own_angle",
    "gear_ratio": "own_angle",
    "gear_eccentricity": "own_angle",
    "joint_compliance": "gravity_torque",
}
#: Family of outside laws -> the driver they are reported with, where the two differ.
_DRIVERS = {"play": "approach", "product": "own_angle"}
#: So many names on one joint are too many.
CROWD = 3
#: … unless one of them explains all but this share of what they explain together.
COMPANY = 0.2


@dataclass(frozen=True)
class Doubt:
    """A place whose structure has no name: `where` as reported, `curve` that follows it."""

    where: Mapping[str, Any]
    curve: str


def doubt_of(fitted: Fitted) -> Doubt | None:
    """The clearest reason to withhold a name, or None where every name stands."""
    named = [i for i, t in enumerate(fitted.terms) if not t.tacit]
    worst, at = LEVEL / max(len(named), 1), None
    for index in named:
        p_value = curve_p_value(fitted, index)
        if p_value < worst:
            worst, at = p_value, index
    if at is not None and "joint" in fitted.terms[at].where:
        return _doubt(fitted.terms[at])
    return _crowded(fitted, named) or _rivalled(fitted, named) or _one_for_many(fitted, named)


def _one_for_many(fitted: Fitted, named: list[int]) -> Doubt | None:
    """Several names, on one joint or all together, that a single law outside the library does at least as well as.

    One law without a name is likelier than two or three with one that happen to add up to it.
    """
    joints = sorted({int(fitted.terms[i].where["joint"]) for i in named if "joint" in fitted.terms[i].where})
    groups = [[i for i in named if fitted.terms[i].where.get("joint") == joint] for joint in joints]
    places = [(j, f) for j in range(1, fitted.recording.situation.joint_count + 1) for f in FAMILIES]
    for group in (named, *(g for g in groups if g != named)):
        if len(group) < 2:
            continue
        advantage, at = best_outsider(fitted, group, places)
        if at is not None and advantage > 0.0 and not _slight(fitted, group, advantage):
            driver = _DRIVERS.get(at[1], at[1])
            return Doubt({"joint": at[0], "driver": driver}, _curve(driver))
    return None


def _crowded(fitted: Fitted, named: list[int]) -> Doubt | None:
    """Three names on one joint stand for one that is not in the library; the curve is the one that does most."""
    joints = [int(fitted.terms[i].where["joint"]) for i in named if "joint" in fitted.terms[i].where]
    for joint in sorted(set(joints)):
        if joints.count(joint) < CROWD:
            continue
        mine = [i for i in named if fitted.terms[i].where.get("joint") == joint]
        if dominant(fitted, mine, COMPANY):
            continue
        families = ("own_angle", "gravity_torque", "approach")
        best = max(families, key=lambda family: outsider_advantage(fitted, mine, joint, family))
        return Doubt({"joint": joint, "driver": best}, _curve(best))
    return None


def _rivalled(fitted: Fitted, named: list[int]) -> Doubt | None:
    """Names on one joint that a single law outside the library explains better than all of them."""
    best, found = MARGIN, None
    joints = {int(fitted.terms[i].where["joint"]) for i in named if "joint" in fitted.terms[i].where}
    for joint in sorted(joints):
        mine = [i for i in named if fitted.terms[i].where.get("joint") == joint]
        for family in ("own_angle", "gravity_torque", "approach", "play"):
            # Play that is wider than most moves looks like a law of the joint's own angle.
            followed = "own_angle" if family == "play" else family
            rivals = [i for i in mine if _family(fitted.terms[i]) == followed]
            if not rivals or all(fitted.terms[i].effect.key == "joint_zero" for i in rivals):
                continue
            advantage = outsider_advantage(fitted, rivals, joint, family)
            advantage += MARGIN + COMBINED if len(rivals) > 1 else 0.0
            if _slight(fitted, rivals, advantage):
                continue
            if advantage > best:
                driver = _DRIVERS.get(family, family)
                best, found = advantage, Doubt({"joint": joint, "driver": driver}, _curve(driver))
    return found


def _slight(fitted: Fitted, rivals: list[int], advantage: float) -> bool:
    """True where an outsider, however certainly better, explains little more than the names do."""
    if len(rivals) > 1 and not dominant(fitted, rivals):
        return False
    more = fitted.rss * float(np.expm1(max(advantage, 0.0) / fitted.size))
    return more < SHARE * max(law_gain(fitted, index) for index in rivals)


def _family(term: Term) -> str | None:
    if term.effect.key == "backlash":
        return "approach" if term.where["driver"] == "approach" else "gravity_torque"
    return _FAMILY.get(term.effect.key)


def _curve(family: str) -> str:
    return "sign" if family == "approach" else family


def _doubt(term: Term) -> Doubt:
    where = {k: v for k, v in term.where.items() if k in ("joint", "driver", "source_joint")}
    if "from_row" in term.where:
        where["driver"] = "time"
        return Doubt(where, "pace")
    curve = term.effect.curve or "own_angle"
    where.setdefault("driver", "own_angle")
    return Doubt(where, curve)


def leftover_doubt(where: Mapping[str, Any]) -> Doubt | None:
    """Structure left at a joint, as something to put a free curve in for."""
    curves = {
        "own_angle": "own_angle",
        "gravity_torque": "gravity_torque",
        "approach": "sign",
        "time": "pace",
    }
    if "joint" not in where:
        return None
    return Doubt(dict(where), curves[where["driver"]])


def stand_in(fitted: Fitted, doubt: Doubt) -> Term | None:
    """The free curve for a doubt; None where it is in already or its driver does not vary."""
    place = joint_curve_place(doubt.where, doubt.curve)
    if any(t.effect is JOINT_CURVE and t.place == place for t in fitted.terms):
        return None
    functions = shape_functions(fitted.recording.situation, doubt.where, doubt.curve)
    count = functions.shape[1] if functions.any() else 0
    # A constant goes with it: the zero of a curve without a name is no finding.
    return Term(JOINT_CURVE, place, np.zeros(count + 1), tacit=True) if count else None
