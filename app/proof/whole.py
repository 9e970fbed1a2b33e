"""One case of an arm that is off everywhere: what was said of it, and how well its model does.

Rules beside those of matching.py:

Transfer. The error of the saved model on the second recording (base, tool and touched points fitted, as any recording
leaves them open), over that of ordinary least squares on the parameters that really were drawn (the oracle) and over
that of an observer who knows their widths too. Not judged where nobody can say what the arm of the next run still has
(a joint that slipped, what drifts).

Self-consistency. The saved model on its own recording gives `after` to `SAME`.

The dominant effect. Its place and name as everywhere; its value when its strengths together are within `NEAR` of the
truth and each within `SIGMAS` standard deviations. Counted where it can be told: over all readings together it is
`STANDS_OUT` times the noise once all else took what it can, and for its value an observer who knows everything else
would know it to `KNOWN`. A compliance carries what is wrong with the masses or with the way the base stands, which no
interval can know: there only `NEAR` is asked.

A reference. Only what changed since may be named; a load's mass is right within `LOAD`.

Shares. Families of `WORTH` or more, true or said, are right within `POINTS`. Counted where the informed observer knows
the share to half of that.

Untrue. A finding that names nothing the arm has, nor does any rival listed with it; or that names what it has with a
value more than half and more than `FAR` standard deviations off. Zeros, lengths and twists, and masses that are not
those described, are there in every such arm, and their values depend on how they are shared out: they are not counted;
nor are the shapes of one joint's friction over its speed, where it has some. Their intervals count where every shape
that the joint has was named, and fades as the library has it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from app.proof.matching import GEOMETRIC, at_place, in_set, names, names_truth
from app.proof.values_said import differences, size, strengths

SAME = 0.01
NEAR, SIGMAS, KNOWN = 0.25, 3.0, 0.08
STANDS_OUT = 15.0
WORTH, POINTS = 0.05, 0.10
FAR = 5.0
LOAD = 0.03
#: A rival is there when its effect is this many times the noise, over all readings together.
THERE = 5.0
#: There in every arm that is off everywhere.
EVERYWHERE = (*GEOMETRIC, "link_inertia")
#: Shapes that share out one joint's friction over its speed among them.
SHAPES = ("coulomb_friction", "viscous_friction", "stribeck_friction", "quadratic_friction")
Z95 = 1.959963984540054

Finding = Mapping[str, Any]


@dataclass(frozen=True)
class Whole:
    """A case with its score; None where something cannot be judged.

    Args:
        transfer, over_best: error on the second recording over the oracle's and the informed observer's.
        consistent: the saved model does on its own recording what it says.
        place, name, listed, value: of the dominant effect.
        shares: (family, true, said) of each share that counts.
        untrue: findings that are not so.
        covered: (effect, parameter, inside) of each stated interval.
        load: the mass of a load against a reference is right.
        unknown: what stands out is no law of the library.
        misses: everything that went wrong, in words.
    """

    transfer: float | None
    over_best: float | None
    consistent: bool | None
    place: bool | None
    name: bool | None
    listed: bool | None
    value: bool | None
    shares: Sequence[tuple[str, float, float]]
    untrue: Sequence[Finding]
    covered: Sequence[tuple[str, str, bool]]
    load: bool | None
    unknown: bool
    misses: Sequence[str]


def judge_whole(answer: Mapping[str, Any], said: Mapping[str, Any], outside: frozenset[str]) -> Whole:
    """Scores one case by the rules above."""
    whole, findings = answer["whole"], said.get("findings", ())
    unknown = any(t["effect"] in outside for t in answer["truth"])
    told = [t for t in answer["truth"] if not unknown and t["norm"] >= STANDS_OUT]
    transfer, over_best = (_ratio(said, whole, key) for key in ("oracle", "informed"))
    consistent = _consistent(said)
    place = name = listed = value = None
    for truth in told:  # one at most
        place, name = _placed(said, truth), any(names_truth(f, truth) for f in findings)
        listed = in_set(findings, truth)
        value = _value(answer, truth, findings)
    shares = list(_shares(answer, said, outside))
    untrue = [f for f in findings if _untrue(f, answer)]
    load = _load(answer, findings)
    misses = [
        *([said["error"]] if "error" in said else []),
        *([f"carried over {transfer:.2f} of the oracle"] if transfer is not None and transfer > 1.15 else []),
        *([_inconsistency(said)] if consistent is False else []),
        *(["dominant effect not named"] if name is False else []),
        *(["dominant value off"] if name and value is False else []),
        *(["mass of the load off"] if load is False else []),
        *(
            f"share of {family} {was:.0%}, said {is_said:.0%}"
            for family, was, is_said in shares
            if abs(was - is_said) > POINTS
        ),
        *(f"untrue: {f['effect']} {dict(f['where'])}" for f in untrue),
    ]
    return Whole(
        transfer=transfer,
        over_best=over_best,
        consistent=consistent,
        place=place,
        name=name,
        listed=listed,
        value=value,
        shares=shares,
        untrue=untrue,
        covered=list(_covered(answer, findings)),
        load=load,
        unknown=unknown,
        misses=misses,
    )


def _placed(said: Mapping[str, Any], truth: Mapping[str, Any]) -> bool:
    """Was the truth's place said, by a finding or, where there is none, by what is left over?"""
    left = (said.get("leftover") or {}).get("where") or {}
    places = [f["where"] for f in said.get("findings", ())]
    places = places or ([left] if said.get("verdict") == "unexplained" else [])
    return any(at_place(where, truth) for where in places)


def _ratio(said: Mapping[str, Any], whole: Mapping[str, Any], key: str) -> float | None:
    """Error on the second recording over an observer's; infinite where there was none to be had."""
    least = whole.get(key)
    if least is None:
        return None
    error = ((said.get("whole") or {}).get("second") or {}).get("fit_rms")
    return float("inf") if error is None else error / least


def _consistent(said: Mapping[str, Any]) -> bool | None:
    if "error" in said or "whole" not in said:
        return None
    promised, kept = _promised(said)
    return kept is not None and promised is not None and abs(kept - promised) <= SAME * promised


def _promised(said: Mapping[str, Any]) -> tuple[float | None, float | None]:
    """`after` and what the saved model gives on the same rows."""
    again = (said.get("whole") or {}).get("self") or {}
    return (said.get("after") or {}).get("fit_rms"), again.get("fit_rms")


def _inconsistency(said: Mapping[str, Any]) -> str:
    promised, kept = _promised(said)
    return f"after {promised}, its model gives {kept}"


def _value(answer: Mapping[str, Any], truth: Mapping[str, Any], findings: Sequence[Finding]) -> bool | None:
    """Is the dominant effect's value right; None where it cannot be known, or an alias was named."""
    if truth.get("value_sd") is None or truth["value_sd"] > KNOWN:
        return None
    exact = [f for f in findings if names(f, truth["effect"], truth["where"])]
    if not exact:
        return None if any(names_truth(f, truth) for f in findings) else False
    off = differences(exact[0], truth)
    near = sum(d * d for d, _ in off) ** 0.5 <= NEAR * size(truth)
    if _wrongly_weighed(answer, truth) or truth["effect"] in SHAPES:
        return near
    return near and all(std is not None and abs(d) <= SIGMAS * std for d, std in off)


def _load(answer: Mapping[str, Any], findings: Sequence[Finding]) -> bool | None:
    """Is a load's mass right; None without a reference and a load."""
    if not answer["whole"].get("reference") or not answer["truth"]:
        return None
    (truth,) = answer["truth"]
    exact = [f for f in findings if names(f, truth["effect"], truth["where"])]
    if not exact:
        return False
    if "link" in truth["where"] and (truth["value_sd"] is None or truth["value_sd"] > LOAD / 3.0):
        return None  # the motion shows where its centre is and not what it weighs
    off, _ = differences(exact[0], truth)[0]
    return abs(off) <= LOAD * truth["parameters"]["mass"]


def _wrongly_weighed(answer: Mapping[str, Any], truth: Mapping[str, Any]) -> bool:
    whole = answer["whole"]
    return bool(whole.get("masses") or whole.get("lean")) and truth["effect"] == "joint_compliance"


def _shares(answer: Mapping[str, Any], said: Mapping[str, Any], outside: frozenset[str]):
    """(family, true, said) of the shares that count."""
    whole = answer["whole"]
    true = whole["families"]
    stated = {f["family"]: f["share"] for f in said.get("families") or ()}
    settled = whole["settled"]
    for family in {**true, **stated} if settled else true:
        was, sigma = (true[family]["share"], true[family]["sigma"]) if family in true else (0.0, 0.0)
        was, is_said = (min(max(share, 0.0), 1.0) for share in (was, stated.get(family, 0.0)))
        if family in whole["shared_out"]:
            continue
        if max(was, is_said) >= WORTH and sigma <= POINTS / 2:
            yield family, was, is_said


def _untrue(finding: Finding, answer: Mapping[str, Any]) -> bool:
    if any(names_truth(finding, t) for t in answer["truth"]):
        return False
    if answer["whole"].get("reference"):
        return True
    if finding["effect"] in EVERYWHERE or _shape_of_friction(finding, answer):
        return False
    members = answer["whole"]["members"]
    there = [m for m in members if m["norm"] >= THERE]
    if any(names(a, m["effect"], m["where"]) for a in finding.get("alternatives", ()) for m in there):
        return False
    own = [m for m in members if names(finding, m["effect"], m["where"])]
    if not own:
        return True
    off = differences(finding, own[0])
    far = any(std and abs(d) > FAR * std for d, std in off)
    return far and sum(d * d for d, _ in off) ** 0.5 > 0.5 * size(own[0])


def _shape_of_friction(finding: Finding, answer: Mapping[str, Any]) -> bool:
    """True of a shape of friction in a joint that has some."""
    joint = (finding.get("where") or {}).get("joint")
    there = [
        m for m in answer["whole"]["members"] if m["effect"] in SHAPES and m["where"].get("joint") == joint
    ]
    return finding["effect"] in SHAPES and bool(there)


def _shared_out(member: Mapping[str, Any], answer: Mapping[str, Any], findings: Sequence[Finding]) -> bool:
    """True of a shape of friction beside another of its joint that was not named, or that fades otherwise."""
    if member["effect"] not in SHAPES:
        return False
    joint = member["where"].get("joint")
    own = [
        m for m in answer["whole"]["members"] if m["effect"] in SHAPES and m["where"].get("joint") == joint
    ]
    whole = all(any(names(f, m["effect"], m["where"]) for f in findings) for m in own)
    return not whole or answer["plan"].get("fading", "tanh") != "tanh"


def _covered(answer: Mapping[str, Any], findings: Sequence[Finding]):
    """(effect, parameter, inside) of every stated 95% interval of something the arm has, named without a rival."""
    referenced = answer["whole"].get("reference")
    for member in answer["truth"] if referenced else answer["whole"]["members"]:
        if member["effect"] in EVERYWHERE or _wrongly_weighed(answer, member):
            continue
        if _shared_out(member, answer, findings):
            continue
        for finding in findings:
            if finding.get("alternatives") or not names(finding, member["effect"], member["where"]):
                continue
            pairs = zip(strengths(member), differences(finding, member), strict=True)
            for name, (off, std) in pairs:
                if std:
                    yield member["effect"], name, abs(off) <= Z95 * std
