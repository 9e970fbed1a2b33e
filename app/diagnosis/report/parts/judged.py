"""A model learnt elsewhere, on this recording."""

from __future__ import annotations

from html import escape
from pathlib import Path

from app.diagnosis.report.parts.case import Case, section, table
from app.diagnosis.report.wording import judged_rows


def judged(case: Case) -> str:
    """The error before and after, nothing searched for; nothing where no model was given."""
    given = case.diagnosis.judged
    if given is None:
        return ""
    first = next(iter(given.steps.values()))
    rows = judged_rows(given, case.language)
    learnt = Path(given.source).name if given.source else case.t("judged.elsewhere")
    words = case.t("judged.nothing_fitted" if first.unit == "Nm" else "judged.set_up_fitted", source=learnt)
    return section(
        case.t("title.judged"),
        f"<p>{escape(words)}</p>",
        table((case.t("judged.step"), case.t("judged.error"), ""), rows, numbers=(1,), fit=True),
    )
