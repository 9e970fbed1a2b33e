"""The error budget as one bar: how much of the error before each family takes away, and what is left."""

from __future__ import annotations

from app.diagnosis.report.budget import Budget, family_name
from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.palette import LIGHT, NOISE, colour
from app.diagnosis.report.wording import digits, measure
from app.diagnosis.wording import FALLBACK, WORDS

WIDTH = 680.0
BAR, TOP, LINE = 30.0, 22.0, 16.0
REST = "rest"  # key of the words for what no family takes away
#: A part narrower than this carries no number inside it; the legend has all numbers.
ROOM = 34.0
#: Width of a letter inside the bar.
LETTER = 6.0
#: Least width of one column of the legend; the same in every language.
COLUMN = 132.0


def budget_bar(of: Budget, language: str = FALLBACK, *, width: float = WIDTH) -> str:
    """One bar with a legend beneath it; "" where there is no budget.

    Colours stand in the picture itself, so that it needs no style of its page.
    """
    if not of.known:
        return ""
    parts = [(s.family, s.amount, colour(s.family)) for s in of.steps if s.amount > 0]
    parts.append((REST, of.rest, NOISE))
    out = [svg.text(0, 13, WORDS.text("budget.before", language), klass="label")]
    out.append(svg.text(width, 13, measure(of.total, of.unit), klass="value end"))
    scale, x = width / of.total, 0.0
    for family, amount, fill in parts:
        wide = amount * scale
        title = svg.tag("title", svg.escaped(f"{family_name(family, language)}: {measure(amount, of.unit)}"))
        out.append(svg.tag("rect", title, x=x, y=TOP, width=max(wide - 1.0, 0.7), height=BAR, fill=fill))
        said = digits(amount, 2)
        if wide > max(ROOM, LETTER * len(said) + 8):
            dark = family in LIGHT or family == REST
            out.append(
                svg.text(
                    x + wide / 2,
                    TOP + BAR / 2 + 4,
                    said,
                    text_anchor="middle",
                    font_size="11",
                    font_weight="600",
                    fill="#1c2730" if dark else "#fff",
                )
            )
        x += wide
    across = max(int(width // COLUMN), 1)
    for k, (family, amount, fill) in enumerate(parts):
        x, y = k % across * width / across, TOP + BAR + LINE * (1 + k // across)
        out.append(svg.tag("rect", x=x, y=y - 9, width=11, height=11, rx=2, fill=fill))
        out.append(svg.text(x + 16, y, f"{family_name(family, language)} {digits(amount, 2)}", klass="label"))
    y = TOP + BAR + LINE * (1 + (len(parts) - 1) // across)
    return svg.picture(width, y + 7, out, WORDS.text("budget.picture", language))
