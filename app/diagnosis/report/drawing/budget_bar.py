"""The error budget as one bar: how much of the error before each family takes away, and what is left."""

from __future__ import annotations

from app.diagnosis.report.budget import SMALL_AMOUNT, Budget, family_name
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
    listed = _legend(parts, of, language)
    for k, (said, fill) in enumerate(listed):
        x, y = k % across * width / across, TOP + BAR + LINE * (1 + k // across)
        out.append(svg.tag("rect", x=x, y=y - 9, width=11, height=11, rx=2, fill=fill))
        out.append(svg.text(x + 16, y, said, klass="label"))
    y = TOP + BAR + LINE * (1 + (len(listed) - 1) // across)
    return svg.picture(width, y + 7, out, WORDS.text("budget.picture", language))


def _legend(parts: list[tuple[str, float, str]], of: Budget, language: str) -> list[tuple[str, str]]:
    """Words and colour of each part; families that nobody sees in the bar are one entry, where there are several."""
    small = [p for p in parts if p[0] != REST and p[1] < SMALL_AMOUNT * of.total]
    small = small if len(small) > 1 else []
    out = [(f"{family_name(p[0], language)} {digits(p[1], 2)}", p[2]) for p in parts if p not in small]
    if small:
        amount = digits(sum(p[1] for p in small), 2)
        out.insert(-1, (f"{WORDS.text('budget.small', language, count=len(small))} {amount}", small[0][2]))
    return out
