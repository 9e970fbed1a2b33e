"""Residual against each thing it may follow."""

from __future__ import annotations

from app.diagnosis.report.curves import driver_curves
from app.diagnosis.report.drawing.scatter import driver_plot
from app.diagnosis.report.parts.case import Case, figure, key, section, soft


def drivers(case: Case) -> str:
    """Small plots, those of the findings first."""
    curves = driver_curves(case.diagnosis, case.robot)
    if not curves:
        return ""
    pictures = "".join(figure(case.picture(driver_plot(curve))) for curve in curves)
    return section(
        case.t("title.drivers"),
        soft(case.t("drivers")),
        key(case),
        f'<div class="grid2">{pictures}</div>',
    )
