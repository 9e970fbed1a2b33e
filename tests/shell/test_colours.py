"""The page's colours by its style sheet: texts, edges and rings have the contrast WCAG 2.1 asks for (AA)."""

import re

import pytest

from app.shell.server import PAGES

TEXT, PART = 4.5, 3.0  # WCAG 2.1, 1.4.3 and 1.4.11
#: Ink on ground, by variable or as written.
WRITTEN = [
    ("ink", "bg"), ("ink", "card"), ("ink", "key"), ("dim", "bg"), ("dim", "card"), ("dim", "key"), ("hot-ink", "hot"),
    ("hot", "card"), ("ok", "card"), ("warn", "card"), ("bad", "card"), ("info", "card"), ("card", "info"),
]  # fmt: skip
#: What is seen without words: edges of fields and keys, rings of the focus, the chosen key beside its neighbours.
SEEN = [
    ("key-edge", "card"),
    ("key-edge", "bg"),
    ("focus", "card"),
    ("focus", "bg"),
    ("focus", "key"),
    ("hot", "key"),
]


def css():
    return (PAGES / "frame.css").read_text(encoding="utf-8")


def themes():
    """Variable -> colour, of the light page and of the dark one."""
    light, dark = (
        dict(re.findall(r"--([\w-]+):(#[0-9a-f]{3,6})", re.search(start + r"\{(.*?)\}", css(), re.S)[1]))
        for start in (r":root", r"\[data-theme=dark\]")
    )
    return {"light": light, "dark": {**light, **dark}}


def brightness(colour):
    digits = colour.lstrip("#")
    digits = "".join(2 * d for d in digits) if len(digits) == 3 else digits
    parts = [int(digits[k : k + 2], 16) / 255.0 for k in (0, 2, 4)]
    linear = [v / 12.92 if v <= 0.03928 else ((v + 0.055) / 1.055) ** 2.4 for v in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(first, second):
    a, b = sorted((brightness(first), brightness(second)), reverse=True)
    return (a + 0.05) / (b + 0.05)


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("pairs, least", [(WRITTEN, TEXT), (SEEN, PART)], ids=["texts", "edges"])
def test_the_colours_of_both_themes_are_told_apart(theme, pairs, least):
    colours = themes()[theme]
    found = {f"{a} on {b}": round(contrast(colours[a], colours[b]), 2) for a, b in pairs}
    assert not {pair: value for pair, value in found.items() if value < least}


def test_every_rule_that_sets_ink_and_ground_of_its_own_is_legible():
    rules = re.findall(r"\{[^{}]*?background:(#[0-9a-f]{3,6})[^{}]*?;color:(#[0-9a-f]{3,6})", css())
    assert len(rules) >= 4  # the stop, its release, the errand and its key
    assert not [(ground, ink) for ground, ink in rules if contrast(ground, ink) < TEXT]


def test_the_measure_is_the_one_of_the_standard():
    assert contrast("#000", "#fff") == pytest.approx(21.0)
    assert contrast("#777", "#fff") == pytest.approx(4.48, abs=0.005)
