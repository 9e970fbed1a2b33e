"""Figures as they are read: nothing has no sign, and a unit stays on the line of its number.

Both are done to words that are finished, where they go to a page, a report or a terminal; never to what a program
reads: JSON, files of points, values of fields.
"""

from __future__ import annotations

import re

from markupsafe import Markup

#: What keeps a number and its unit together; a program that strips or splits at white space takes it as a space.
NO_BREAK = "\u00a0"
_UNITS = (
    "mm", "µm", "m", "deg", "°", "degrees", "rad", "mrad", "µrad", "Nm", "N", "kg", "s", "ms", "µs", "min", "minutes",
    "h", "Hz", "kB", "MB", "GB", "%", "毫米", "度", "秒", "分钟",
)  # fmt: skip
_ONE = "|".join(sorted(_UNITS, key=len, reverse=True))
_UNIT = rf"(?:{_ONE})(?:/(?:{_ONE}|A|K))?"
_PARTED = re.compile(rf"(?<=\d) (?=(?:{_UNIT})(?![A-Za-z]))|(?<=\d kg) (?=m(?:²|\b))|(?<=[±≤≥]) (?=\d)")
#: A tag, or what is no text though it stands between two tags, or is copied or sent back as it stands; or a text.
_IN_MARKUP = re.compile(r"<(style|script|textarea|pre|code)\b.*?</\1>|<[^>]*>|(?P<text>[^<]+)", re.DOTALL)
#: A zero with a sign. What is cited, or part of a name, a date or a longer number, is none; in a column, after two
#: spaces or at the beginning of a line, the figure keeps its place.
_SIGNED = re.compile(
    r"(?:(?P<pad>  |^ )|(?<![\w.'\"“‘`)\]-])(?<!&#3[49];))-(?P<zero>0(?:\.0+)?)(?!\.?\d|[eE][-+]?\d|\w*['\"”’`])",
    re.MULTILINE,
)


def unsigned(text: str) -> str:
    """The text with `-0.00` as `0.00`: a value that rounds to nothing has no sign."""
    if "-0" not in text:
        return text
    return _SIGNED.sub(lambda found: (found["pad"] + " " if found["pad"] else "") + found["zero"], text)


def together(text: str) -> str:
    """The text with each number and its unit on one line, and `±` with its number."""
    return _PARTED.sub(NO_BREAK, unsigned(text)) if " " in text else unsigned(text)


def in_markup(content: str) -> str:
    """Like `together`, for the texts between tags; tags, pictures' coordinates and styles stay as they are."""
    return _IN_MARKUP.sub(lambda found: together(found[0]) if found["text"] else found[0], content)


def finished(value: object) -> object:
    """What a template puts in, as it is read: `finalize` of Jinja2. Markup is finished already."""
    return together(value) if isinstance(value, str) and not isinstance(value, Markup) else value
