"""Residual against each thing it may follow."""

from __future__ import annotations

from markupsafe import Markup

from app.diagnosis.report.curves import driver_curves
from app.diagnosis.report.drawing.scatter import driver_plot
from app.diagnosis.report.parts.case import Case


def drivers(case: Case) -> Markup | str:
    """Small plots, those of the findings first."""
    curves = driver_curves(case.diagnosis, case.robot)
    if not curves:
        return ""
    return case.section(
        "pictures.html",
        title=case.t("title.drivers"),
        intro=case.t("drivers"),
        marks=case.marks(),
        pictures=[case.picture(driver_plot(curve)) for curve in curves],
    )
