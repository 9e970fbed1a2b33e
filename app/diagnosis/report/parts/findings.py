"""One card a finding: where, what, how much, how sure, what else it could be."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from app.diagnosis.report.parts.case import Case, section, table
from app.diagnosis.report.wording import digits, effect_title, fall, measure, place, probability, quantity
from app.diagnosis.result import Finding

#: With more findings than this a table of all of them stands first.
_A_FEW = 3


def findings(case: Case) -> str:
    """The cards, in the order of the findings; a table first where there are many."""
    d = case.diagnosis
    cards = [_card(n, f, d.after.unit) for n, f in enumerate(d.findings, 1)]
    if len(cards) <= _A_FEW:
        return section("What was left out", *cards)
    return section("What was left out", _overview(d.findings, d.after.unit)) + section("One by one", *cards)


def _overview(found: Sequence[Finding], unit: str) -> str:
    heads = ("", "effect", "where", "value", f"held out without it [{unit}]")
    rows = [
        (
            str(n),
            effect_title(f.effect),
            place(f.where),
            quantity(f.parameters[0]) if f.parameters else "",
            measure(f.heldout_rms_without, f.heldout_unit)
            if f.heldout_unit
            else digits(f.heldout_rms_without),
        )
        for n, f in enumerate(found, 1)
    ]
    return table(heads, rows, numbers=(3, 4))


def _card(number: int, f: Finding, unit: str) -> str:
    unit = f.heldout_unit or unit
    values = "".join(
        f"<dt>{escape(p.name.replace('_', ' '))}</dt><dd><b>{escape(quantity(p))}</b></dd>"
        for p in f.parameters
    )
    if f.equation:
        values += f'<dt>law</dt><dd class="law">{escape(f.equation)}</dd>'
    smaller = fall(f.heldout_rms_without, f.heldout_rms_with)
    held = (
        f"{escape(measure(f.heldout_rms_without, unit))} without it<br>"
        f"{escape(measure(f.heldout_rms_with, unit))} with it{f' ({smaller})' if smaller else ''}"
    )
    share = max(0.0, min(1.0, f.visible))
    sure = (
        f"<dt>certainty</dt><dd>{escape(probability(f.p_value))}</dd>"
        f'<dt>visible</dt><dd><span class="meter"><i style="width:{share:.0%}"></i></span>{share:.0%}</dd>'
        f"<dt>held out</dt><dd>{held}</dd>"
        + ("" if f.alternatives else "<dt>others</dt><dd>no known effect fits about as well</dd>")
    )
    return (
        f'<div class="card"><div class="top"><span class="no">{number}</span>'
        f'<h3>{escape(effect_title(f.effect))}</h3><span class="where">{escape(place(f.where))}</span></div>'
        f'<p class="say">{escape(f.sentence)}</p>'
        f'<div class="facts"><dl>{values}</dl><dl>{sure}</dl></div>{_alternatives(f)}</div>'
    )


def _alternatives(f: Finding) -> str:
    said = "; ".join(
        f"{effect_title(a.effect)} at {place(a.where)} (ΔBIC {a.delta_bic:+.1f})" for a in f.alternatives
    )
    return f'<p class="alt">This recording does not rule out: {escape(said)}.</p>' if said else ""
