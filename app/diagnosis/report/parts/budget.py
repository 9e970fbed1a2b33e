"""Where the error comes from: the budget as a bar and a sentence, what is left beside it, before and after."""

from __future__ import annotations

from markupsafe import Markup

from app.diagnosis.report.budget import budget, budget_sentence, unexplained_sentence
from app.diagnosis.report.drawing.bars import before_after_bars
from app.diagnosis.report.drawing.budget_bar import budget_bar
from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.templating import drawn
from app.diagnosis.report.wording import fall, measure, noise_source, probability


def where_from(case: Case) -> Markup:
    """The first section: an engineer sees at a glance what takes most of the error away."""
    d, language = case.diagnosis, case.language
    of = budget(d)
    p = probability(d.leftover.p_value, language)
    left = unexplained_sentence(d, language)
    beside = [left or case.t("leftover.nothing", p=p)]
    noise = case.t(
        "noise", value=measure(d.noise.value, d.noise.unit), source=noise_source(d.noise.source, language)
    )
    more = [("n", noise)] if d.noise.unit == d.before.unit else []
    if d.judged is not None:
        more.insert(0, ("g", case.t("key.given")))
    smaller = fall(d.before.heldout_rms, d.after.heldout_rms, language)
    return case.section(
        "budget.html",
        title=case.t(f"title.budget_{'torque' if of.unit == 'Nm' else 'length'}"),
        sentence=budget_sentence(d, language),
        bar=drawn(budget_bar(of, language)),
        beside=beside,
        marks=case.marks(*more),
        states=case.picture(before_after_bars(d)),
        caption=case.t("caption.fall", fall=smaller) if d.findings and smaller else case.t("caption.error"),
    )
