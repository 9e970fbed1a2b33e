"""Residual arrows at the places they were measured: from above and from the side, before and after."""

from __future__ import annotations

from markupsafe import Markup

from app.diagnosis.report.curves import residual_vectors
from app.diagnosis.report.drawing.arrows import arrow_plot, magnification
from app.diagnosis.report.parts.case import Case


def space(case: Case) -> Markup | str:
    """Nothing for recordings without points."""
    evidence = case.diagnosis.evidence
    if evidence is None or evidence.points_predicted_before is None or residual_vectors(evidence)[0] is None:
        return ""
    factor = magnification(evidence)
    states = (False, True) if case.changed else (False,)
    return case.section(
        "pictures.html",
        title=case.t("title.space"),
        intro=case.t("space", factor=f"{factor:g}"),
        marks=case.marks(),
        pictures=[
            case.picture(arrow_plot(evidence, view, after=after, factor=factor, title=title))
            for view, title in (((0, 1), "From above"), ((0, 2), "From the side"))
            for after in states
        ],
    )
