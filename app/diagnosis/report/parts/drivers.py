"""Residual against each thing it may follow."""

from __future__ import annotations

from app.diagnosis.report.curves import driver_curves
from app.diagnosis.report.drawing.scatter import driver_plot
from app.diagnosis.report.parts.case import Case, figure, key, section


def drivers(case: Case) -> str:
    """Small plots, those of the findings first."""
    curves = driver_curves(case.diagnosis, case.robot)
    if not curves:
        return ""
    pictures = "".join(figure(driver_plot(curve)) for curve in curves)
    return section(
        "What the error follows",
        '<p class="small soft">Each dot is a row of the recording; the line is the mean of neighbouring rows. '
        "A line that stays at zero means the error does not follow that quantity.</p>",
        key(case),
        f'<div class="grid2">{pictures}</div>',
    )
