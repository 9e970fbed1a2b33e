"""Before, after and, where a model was given, with it: bars against the noise floor."""

from __future__ import annotations

import math

from app.diagnosis.judging import WITH
from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.axes import tick_text, ticks
from app.diagnosis.report.wording import measure
from app.diagnosis.result import Diagnosis

WIDTH, LEFT, RIGHT, BAR, GAP = 680.0, 92.0, 70.0, 15.0, 12.0


def before_after_bars(diagnosis: Diagnosis, *, width: float = WIDTH) -> str:
    """Error on fitted and held-out rows, side by side; a dashed line where the noise lies."""
    d = diagnosis
    unit = d.before.unit
    states = [(d.before, "fill-before"), (d.after, "fill-after")]
    if d.judged is not None and WITH in d.judged.steps and d.judged.steps[WITH].unit == unit:
        states.append((d.judged.steps[WITH], "fill-given"))
    rows = (
        ("rows fitted", [(s.fit_rms, klass) for s, klass in states]),
        ("rows held out", [(s.heldout_rms, klass) for s, klass in states]),
    )
    # The noise is that of one component and comparable only in the same unit.
    noise = d.noise.value if d.noise.unit == unit and math.isfinite(d.noise.value) else None
    values = [v for _, bars in rows for v, _ in bars if v is not None and math.isfinite(v)]
    top = max([*values, noise or 0.0, 1e-12]) * 1.02
    scale = (width - LEFT - RIGHT) / top
    height = 2 * (len(states) * BAR + GAP) + 34
    out = []
    bottom = height - 26
    for value in ticks(0.0, top, 5):
        x = LEFT + value * scale
        out.append(svg.tag("line", klass="grid", x1=x, x2=x, y1=6, y2=bottom))
        out.append(svg.text(x, bottom + 12, tick_text(value), klass="tick mid"))
    # It ends where the paper does: the last number may stand at the end of the scale, half of it beyond.
    out.append(svg.text(width - 4, bottom + 12, unit, klass="label end"))
    y = 10.0
    for label, bars in rows:
        out.append(svg.text(LEFT - 8, y + len(bars) * BAR / 2 + 2, label, klass="label end"))
        for value, klass in bars:
            if value is not None and math.isfinite(value):
                wide = max(value * scale, 1)
                out.append(svg.tag("rect", klass=klass, x=LEFT, y=y, width=wide, height=BAR - 2))
                out.append(svg.text(LEFT + wide + 5, y + BAR - 5, measure(value, unit), klass="value"))
            y += BAR
        y += GAP
    if noise is not None:
        x = LEFT + noise * scale
        out.append(svg.tag("line", klass="noise", x1=x, x2=x, y1=2, y2=bottom))
    return svg.picture(width, height, out, "Error before and after, against the noise")
