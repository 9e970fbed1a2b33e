"""When an answer is right. Every rule the scorer follows stands here.

Names. A finding names a truth when the effect's key is the same and every part of `where` that tells places
apart is the same: joint, source_joint, link, axis, body, for backlash the driver and for gears the waves a turn (one
where it is not said). A part the finding leaves out (an axis that cannot be told) is not held against it; a part it
states must be right. A step's row may be `ROWS` rows off, a time `SECONDS` seconds.

Places. Joint, link, body or instrument without the name of the effect. Link k and joint k are different places.
Where nothing was named, the place that the left-over points at counts as the place said.

Aliases. No exception is written by hand. Two explanations are one where this very recording cannot tell them
apart: the generator's own forward model fits the other effect (its strength free) and everything open (base, tool,
targets; all geometry where the arm's geometry is off) to the true one, and what remains is shorter than `ALIKE` noise
standard deviations over all readings together. An observer who knew that only these two are possible
would still be wrong in one of six cases. This finds, and the tests hold, the classes known by theory: joint
1's zero and the base, lengths along parallel axes, backlash by gravity's sign on a joint whose load never
changes sign and that joint's zero, indentation along the tool and the tool's length.

Reported set. A truth is in the set when a finding, or any alternative listed with a finding, names it.

Not scored as names: geometry (joint_zero, link_length, link_twist) where all of the arm's geometry is off,
because it is true there, dry and viscous friction where every joint of the arm has some, a link's masses where one
factor is on all torques, because nobody without a known mass can tell these apart; and effects that survive
by less than `SURVIVES`, which are counted apart.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

ROWS = 2
SECONDS = 0.3
ALIKE = 2.0
SURVIVES = 1.5
#: An effect of no library is tellable from the library where it differs by this much (noise units, all readings).
TELLABLE = 8.0

GEOMETRIC = ("joint_zero", "link_length", "link_twist")
FRICTION = ("coulomb_friction", "viscous_friction")
APART = ("joint", "source_joint", "link", "axis", "body")

Where = Mapping[str, Any]


def names(said: Mapping[str, Any], effect: str, where: Where) -> bool:
    """True where the finding or alternative `said` is this effect at this place."""
    if said.get("effect") != effect:
        return False
    stated = said.get("where") or {}
    keys = (*APART, "driver") if effect == "backlash" else APART
    for key in keys:
        if key in stated and key in where and stated[key] != where[key]:
            return False
        # a joint or link that must be told and is not
        if key in ("joint", "link") and key in where and key not in stated:
            return False
    if effect == "gear_eccentricity" and stated.get("order", 1) != where.get("order", 1):
        return False
    # one factor for all torques is not one joint's
    if effect == "torque_constant" and ("joint" in stated) != ("joint" in where):
        return False
    return _times_match(stated, where)


def names_truth(said: Mapping[str, Any], truth: Mapping[str, Any]) -> bool:
    """True where `said` names the truth or one of its aliases in this recording."""
    if names(said, truth["effect"], truth["where"]):
        return True
    return any(names(said, alias["effect"], alias["where"]) for alias in truth.get("lookalikes", ()))


def place_of(where: Where) -> tuple[str, Any] | None:
    """The place without the effect."""
    for key in ("joint", "link", "body"):
        if where.get(key) is not None:
            return key, where[key]
    return None


def at_place(where: Where, truth: Mapping[str, Any]) -> bool:
    """True where this is the truth's place, or an alias's."""
    said = place_of(where)
    if said is None and not where.get("driver"):
        return not where and not truth["where"]  # one factor for all torques has the whole arm for a place
    true = [truth["where"], *(alias["where"] for alias in truth.get("lookalikes", ()))]
    # What acts on the whole arm (late torques) has its driver for a place.
    return any(
        said == place_of(w) and _times_match(where, w) and (said or where["driver"] == w.get("driver"))
        for w in true
    )


def in_set(findings: Sequence[Mapping[str, Any]], truth: Mapping[str, Any]) -> bool:
    """True where a finding or one of its alternatives names the truth."""
    return any(
        names_truth(said, truth)
        for finding in findings
        for said in (finding, *finding.get("alternatives", ()))
    )


def counted(findings: Sequence[Mapping[str, Any]], answer: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The findings that are held against, or for, the diagnosis."""
    true = (*(GEOMETRIC if answer.get("clutter_mm") else ()), *(FRICTION if answer.get("friction") else ()))
    if any(t["effect"] == "torque_constant" and "joint" not in t["where"] for t in answer["truth"]):
        true = (*true, "link_inertia")
    return [f for f in findings if f["effect"] not in true]


def _times_match(stated: Where, where: Where) -> bool:
    if "from_row" in where and "from_row" in stated and abs(stated["from_row"] - where["from_row"]) > ROWS:
        return False
    for key in ("from_s", "to_s"):
        if key in where and key in stated and abs(stated[key] - where[key]) > SECONDS:
            return False
    return True
