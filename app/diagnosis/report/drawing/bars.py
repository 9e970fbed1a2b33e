"""Before and after as two pairs of bars against the noise floor."""

from __future__ import annotations

import math

from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.axes import tick_text, ticks
from app.diagnosis.report.wording import measure
from app.diagnosis.result import Diagnosis

WIDTH, LEFT, RIGHT, BAR, GAP = 680.0, 92.0, 70.0, 15.0, 16.0


def before_after_bars(diagnosis: Diagnosis, *, width: float = WIDTH) -> str:
    """Error on fitted and held-out rows, before and after; a dashed line where the noise lies."""
    d = diagnosis
    unit = d.before.unit
    rows = (
        ("rows fitted", d.before.fit_rms, d.after.fit_rms),
        ("rows held out", d.before.heldout_rms, d.after.heldout_rms),
    )
    # The noise is that of one component and comparable only in the same unit.
    noise = d.noise.value if d.noise.unit == unit and math.isfinite(d.noise.value) else None
    values = [v for _, *pair in rows for v in pair if v is not None and math.isfinite(v)]
    top = max([*values, noise or 0.0, 1e-12]) * 1.02
    scale = (width - LEFT - RIGHT) / top
    height = 2 * (2 * BAR + GAP) + 34
    out = []
    bottom = height - 26
    for value in ticks(0.0, top, 5):
        x = LEFT + value * scale
        out.append(svg.tag("line", klass="grid", x1=x, x2=x, y1=6, y2=bottom))
        out.append(svg.text(x, bottom + 12, tick_text(value), klass="tick mid"))
    out.append(svg.text(width - RIGHT + 6, bottom + 12, unit, klass="label"))
    y = 10.0
    for label, before, after in rows:
        out.append(svg.text(LEFT - 8, y + BAR + 3, label, klass="label end"))
        for value, klass in ((before, "fill-before"), (after, "fill-after")):
            if value is not None and math.isfinite(value):
                out.append(
                    svg.tag("rect", klass=klass, x=LEFT, y=y, width=max(value * scale, 1), height=BAR - 2)
                )
                out.append(
                    svg.text(
                        LEFT + max(value * scale, 1) + 5, y + BAR - 5, measure(value, unit), klass="value"
                    )
                )
            y += BAR
        y += GAP
    if noise is not None:
        x = LEFT + noise * scale
        out.append(svg.tag("line", klass="noise", x1=x, x2=x, y1=2, y2=bottom))
    return svg.picture(width, height, out, "Error before and after, against the noise")
