"""What was left out, by family: each law with place, value, share, certainty and what else it could be."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from markupsafe import Markup

from app.diagnosis.quantity import quantity
from app.diagnosis.report.budget import (
    budget,
    family_name,
    folded_sentence,
    law_share,
    percent,
    shared_note,
    shown,
    takes_away,
)
from app.diagnosis.report.drawing.palette import OTHER, colour
from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.wording import (
    effect_title,
    finding_law,
    finding_sentence,
    measure,
    parameter_name,
    place,
    probability,
    rivals,
)
from app.diagnosis.result import Finding


def findings(case: Case) -> Markup | str:
    """Families in the budget's order, their laws beneath; small laws folded."""
    of = budget(case.diagnosis)
    groups = [
        _group(case, s.members, s.small)
        | {
            "name": family_name(s.family, case.language),
            "amount": takes_away(s, of),
            "share": case.t("found.comes_back", share=percent(s.share)),
            "colour": colour(s.family),
        }
        for s in shown(of)
    ]
    if of.others:
        said = family_name("others", case.language)
        groups.append(
            _group(case, of.others, ()) | {"name": said, "amount": "", "share": "", "colour": OTHER}
        )
    return (
        case.section("findings.html", groups=groups, note=shared_note(shown(of), of, case.language))
        if groups
        else ""
    )


def _group(case: Case, members: Sequence[int], small: Sequence[int]) -> dict[str, Any]:
    found = case.diagnosis.findings
    count = len(members) + len(small)
    return {
        "members": [_law(case, k + 1, found[k]) for k in members],
        "small": [_law(case, k + 1, found[k]) for k in small],
        "laws": list(
            dict.fromkeys(_equation(case, found[k]) for k in (*members, *small) if found[k].equation)
        ),
        "folded": folded_sentence(len(small), case.language),
        "count": case.t("found.one_law" if count == 1 else "found.laws", count=count) if count else "",
        "open": bool(members),
    }


def _equation(case: Case, f: Finding) -> str:
    """Its effect and the law, said once for all of a family."""
    return f"{effect_title(f.effect, case.language)}: {finding_law(f, case.language)}"


def _law(case: Case, number: int, f: Finding) -> dict[str, Any]:
    language, unit = case.language, f.heldout_unit or case.diagnosis.after.unit
    others = rivals(f, language)
    return {
        "number": number,
        "effect": effect_title(f.effect, language),
        "where": place(f.where, language),
        "sentence": finding_sentence(f, language),
        "others": case.t("found.not_ruled_out", what=others) if others else "",
        "given": [(parameter_name(p.name, language), quantity(p, language)) for p in f.parameters],
        "share": percent(law_share(f, case.diagnosis)),
        "held": f"{measure(f.heldout_rms_without, unit)} → {measure(f.heldout_rms_with, unit)}",
        "visible": f"{max(0.0, min(1.0, f.visible)):.0%}",
        "p": probability(f.p_value, language),
    }
