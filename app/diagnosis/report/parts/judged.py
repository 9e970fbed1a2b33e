"""A model learnt elsewhere, on this recording."""

from __future__ import annotations

from pathlib import Path

from markupsafe import Markup

from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.wording import judged_rows


def judged(case: Case) -> Markup | str:
    """The error before and after, nothing searched for; nothing where no model was given."""
    given = case.diagnosis.judged
    if given is None:
        return ""
    first = next(iter(given.steps.values()))
    learnt = Path(given.source).name if given.source else case.t("judged.elsewhere")
    return case.section(
        "judged.html",
        words=case.t(
            "judged.nothing_fitted" if first.unit == "Nm" else "judged.set_up_fitted", source=learnt
        ),
        heads=(case.t("judged.step"), case.t("judged.error"), ""),
        rows=judged_rows(given, case.language),
    )
