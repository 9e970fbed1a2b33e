"""Texts never become markup: by the pieces' templates, and at the panel's own door."""

import pytest

from app.panel import Panel
from app.panel import markup as html

BAD = "<script>alert('x')</script>&\""
INNER = html.paragraph("inside")


def pieces(text):
    """Every piece there is, the text in each of its places."""
    return {
        "paragraph": html.paragraph(text, testid=text),
        "light": html.light("red", text, testid=text),
        "light's colour": html.light(text, "x"),
        "table": html.table([(text, text)], head=(text, text), testid=text),
        "notes": html.notes([("red", text), (text, "x")]),
        "instruction": html.instruction(text, text, testid=text),
        "facts": html.facts([(text, text)], testid=text),
        "bar": html.bar(text, 0.5, text, text),
        "more": html.more(text, INNER),
        "more with a plain text": html.more("x", text),
        "block with a plain text": html.block(text),
        "block's edge": html.block(INNER, edge=text, look=text),
        "joined": html.joined([INNER, text]),
        "added": INNER + text,
        "safe": html.safe("<b>{}</b>", text),
    }


@pytest.mark.parametrize("name", pieces("x"))
def test_nothing_from_outside_becomes_markup(name):
    piece = pieces(BAD)[name]
    assert "<script" not in piece and "&lt;script" in piece and '&"' not in piece


def test_every_piece_is_among_them():
    made = {getattr(html, name) for name in html.__all__ if callable(getattr(html, name))}
    assert {f.__name__ for f in made} == {
        "Markup", "bar", "block", "escape", "facts", "instruction", "joined", "light", "more", "notes", "paragraph",
        "safe", "table",
    }  # fmt: skip


def test_a_panel_takes_markup_from_the_pieces_and_escapes_all_else():
    panel = Panel()
    shown = panel.add_html(BAD)
    assert "<script" not in shown.content
    shown.content = INNER
    assert shown.content == '<p class="">inside</p>' and type(shown.content) is str
    shown.content = f"{INNER}{BAD}"  # put together as text, it is text
    assert "<" not in shown.content


def test_a_light_names_its_colour_for_those_who_cannot_see_it():
    assert 'data-colour="green"' in html.light("green", "good")


def test_no_remarks_take_no_room():
    assert html.notes([]) == ""
