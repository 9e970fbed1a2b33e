"""Small pieces of text with structure, by templates that escape every text (Jinja2, autoescape).

What a piece gives is `Markup`: joined to other pieces with `+` or `joined`, it stays what it is, and a plain text that
is added to it is escaped. A panel takes nothing else as markup (Panel.set). How pieces look is the page's affair:
classes, no styles, but for a colour that stands for something in a picture.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

__all__ = [
    "LEVELS", "Markup", "bar", "block", "escape", "facts", "instruction", "joined", "light", "more", "notes",
    "paragraph", "safe", "table",
]  # fmt: skip

#: Level of a message -> colour of its lamp.
LEVELS = {"info": "blue", "good": "green", "warning": "yellow", "error": "red"}


@cache
def _pieces() -> Any:
    loader = FileSystemLoader(Path(__file__).parent / "templates")
    environment = Environment(loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    return environment.get_template("pieces.html").module


def joined(pieces: Iterable[str]) -> Markup:
    """Pieces one after the other; a plain text among them is escaped."""
    return Markup("").join(pieces)


def safe(form: str, /, *texts: object) -> Markup:
    """Markup of our own with texts in it, which are escaped: `safe("<b>{}</b>", name)`. `form` is never data."""
    return Markup(form).format(*texts)


def block(inner: str, *, testid: str = "", look: str = "", edge: str = "") -> Markup:
    """A block of markup, with a hook for tests, classes of the page, and the colour of its edge."""
    return _pieces().block(inner, testid, look, edge)


def paragraph(text: str, *, testid: str = "", faint: bool = False, strong: bool = False) -> Markup:
    """One paragraph of plain text."""
    return _pieces().paragraph(text, testid, " ".join(["faint"] * faint + ["strong"] * strong))


def instruction(title: str, words: str, testid: str = "next") -> Markup:
    """What to do next."""
    return _pieces().instruction(title, words, testid)


def light(colour: str, text: str, *, testid: str = "light") -> Markup:
    """The traffic light with its reason."""
    return _pieces().light(colour, text, testid)


def table(rows: Iterable[Sequence[str]], *, head: Sequence[str] = (), testid: str = "") -> Markup:
    """Plain texts in rows; the first column reads left, all others right."""
    return _pieces().table(list(rows), head, testid)


def facts(pairs: Iterable[tuple[str, str]], *, testid: str = "") -> Markup:
    """A few figures under their names, side by side: what is read first."""
    return _pieces().facts(list(pairs), testid)


def notes(items: Iterable[tuple[str, str]], *, testid: str = "notes") -> Markup:
    """Remarks, each with the colour of its level."""
    items = list(items)
    return _pieces().notes(items, testid) if items else Markup("")


def bar(label: str, share: float, colour: str, words: str, *, testid: str = "") -> Markup:
    """A share of a whole as a bar, with its words."""
    return _pieces().bar(label, round(100 * min(max(share, 0.0), 1.0)), colour, words, testid)


def more(title: str, inner: str, *, testid: str = "") -> Markup:
    """Markup that unfolds."""
    return _pieces().more(title, inner, testid)
