"""One card a finding: where, what, how much, how sure, what else it could be."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from app.diagnosis.report.parts.case import Case, section, table
from app.diagnosis.report.wording import (
    digits,
    effect_title,
    fall,
    finding_law,
    finding_sentence,
    measure,
    parameter_name,
    place,
    probability,
    quantity,
)
from app.diagnosis.result import Finding

#: With more findings than this a table of all of them stands first.
_A_FEW = 3


def findings(case: Case) -> str:
    """The cards, in the order of the findings; a table first where there are many."""
    d = case.diagnosis
    cards = [_card(case, n, f, d.after.unit) for n, f in enumerate(d.findings, 1)]
    if len(cards) <= _A_FEW:
        return section(case.t("title.findings"), *cards)
    overview = _overview(case, d.findings, d.after.unit)
    return section(case.t("title.findings"), overview) + section(case.t("title.one_by_one"), *cards)


def _overview(case: Case, found: Sequence[Finding], unit: str) -> str:
    heads = (
        "",
        *(case.t(f"found.{key}") for key in ("effect", "where", "value")),
        case.t("found.heldout_without", unit=unit),
    )
    rows = [
        (
            str(n),
            effect_title(f.effect, case.language),
            place(f.where, case.language),
            quantity(f.parameters[0], case.language) if f.parameters else "",
            measure(f.heldout_rms_without, f.heldout_unit)
            if f.heldout_unit
            else digits(f.heldout_rms_without),
        )
        for n, f in enumerate(found, 1)
    ]
    return table(heads, rows, numbers=(3, 4))


def _card(case: Case, number: int, f: Finding, unit: str) -> str:
    unit, language = f.heldout_unit or unit, case.language
    values = "".join(
        f"<dt>{escape(parameter_name(p.name, language))}</dt><dd><b>{escape(quantity(p, language))}</b></dd>"
        for p in f.parameters
    )
    if f.equation:
        values += f'<dt>{case.t("found.law")}</dt><dd class="law">{escape(finding_law(f, language))}</dd>'
    smaller = fall(f.heldout_rms_without, f.heldout_rms_with, language)
    without = case.t("found.without_it", error=measure(f.heldout_rms_without, unit))
    with_it = case.t("found.with_it", error=measure(f.heldout_rms_with, unit))
    held = f"{escape(without)}<br>{escape(with_it)}{f' ({smaller})' if smaller else ''}"
    share = max(0.0, min(1.0, f.visible))
    sure = (
        f"<dt>{case.t('found.certainty')}</dt><dd>{escape(probability(f.p_value, language))}</dd>"
        f"<dt>{case.t('found.visible')}</dt>"
        f'<dd><span class="meter"><i style="width:{share:.0%}"></i></span>{share:.0%}</dd>'
        f"<dt>{case.t('found.held_out')}</dt><dd>{held}</dd>"
        + ("" if f.alternatives else f"<dt>{case.t('found.others')}</dt><dd>{case.t('found.no_other')}</dd>")
    )
    return (
        f'<div class="card"><div class="top"><span class="no">{number}</span>'
        f"<h3>{escape(effect_title(f.effect, language))}</h3>"
        f'<span class="where">{escape(place(f.where, language))}</span></div>'
        f'<p class="say">{escape(finding_sentence(f, language))}</p>'
        f'<div class="facts"><dl>{values}</dl><dl>{sure}</dl></div>{_alternatives(case, f)}</div>'
    )


def _alternatives(case: Case, f: Finding) -> str:
    said = case.t("found.between").join(
        case.t(
            "found.alternative",
            effect=effect_title(a.effect, case.language),
            where=place(a.where, case.language),
            delta=f"{a.delta_bic:+.1f}",
        )
        for a in f.alternatives
    )
    return f'<p class="alt">{escape(case.t("found.not_ruled_out", what=said))}</p>' if said else ""
