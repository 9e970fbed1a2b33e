"""A model learnt elsewhere, on this recording."""

from __future__ import annotations

from html import escape
from pathlib import Path

from app.diagnosis.report.parts.case import Case, section, table
from app.diagnosis.report.wording import fall, measure


def judged(case: Case) -> str:
    """The error before and after, nothing searched for; nothing where no model was given."""
    given = case.diagnosis.judged
    if given is None:
        return ""
    first = next(iter(given.steps.values()))
    rows = [
        (what, measure(q.heldout_rms, q.unit), "" if q is first else fall(first.heldout_rms, q.heldout_rms))
        for what, q in given.steps.items()
    ]
    learnt = Path(given.source).name if given.source else "another recording"
    fitted = "Nothing was fitted." if first.unit == "Nm" else "Base and tool were fitted anew, nothing else."
    words = f"<p>The model was learnt on {escape(learnt)}. {fitted}</p>"
    return section(
        "The given model on this recording",
        words,
        table(("in the simulation", "error", ""), rows, numbers=(1,), fit=True),
    )
