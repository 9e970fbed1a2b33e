"""Pictures in the reader's language: they are drawn with English labels, which are put into words here.

The labels carry names that engines give (`labels.py`), so each is known by its shape and not by a key.
"""

from __future__ import annotations

import re
from html import escape, unescape

from app.diagnosis.wording import WORDS
from app.phrases import FALLBACK


def _compiled(*labels: tuple[str, str]) -> tuple[tuple[re.Pattern[str], str], ...]:
    return tuple((re.compile(pattern), key) for pattern, key in labels)


_SAID = re.compile(r'(<text\b[^>]*>|aria-label=")([^<"]*)')
#: Labels that stand alone, whole -> the key of their translation.
_LABELS = _compiled(
    (r"rows fitted", "fitted"),
    (r"rows held out", "held_out"),
    (r"joint (?P<n>\d+)", "joint"),
    (r"joint (?P<n>\d+): torque \[(?P<unit>[^\]]+)\]", "torque"),
    (r"torque error of joint (?P<n>\d+) \[(?P<unit>[^\]]+)\]", "torque_error"),
    (r"joint (?P<n>\d+) off by \[(?P<unit>[^\]]+)\]", "off"),
    (r"error along its main direction \[(?P<unit>[^\]]+)\]", "along"),
    (r"time \[row\]", "row_time"),
    (r"time \[(?P<unit>[^\]]+)\]", "time"),
    (r"temperature \[(?P<unit>[^\]]+)\]", "temperature"),
    (r"line of the file", "line"),
    (r"gravity torque of joint (?P<n>\d+) \[(?P<unit>[^\]]+)\]", "gravity_torque"),
    (r"angle of joint (?P<n>\d+) \[(?P<unit>[^\]]+)\]", "angle"),
    (r"position of joint (?P<n>\d+) \[(?P<unit>[^\]]+)\]", "position"),
    (r"last move of joint (?P<n>\d+)", "last_move"),
    (r"speed of joint (?P<n>\d+) \[(?P<unit>[^\]]+)\]", "speed"),
    (r"acceleration of joint (?P<n>\d+) \[(?P<unit>[^\]]+)\]", "acceleration"),
    (r"temperature of joint (?P<n>\d+) \[(?P<unit>[^\]]+)\]", "joint_temperature"),
    (r"From above", "above"),
    (r"From the side", "side"),
    (r"(?P<axis>[xyz]) of base \[(?P<unit>[^\]]+)\]", "of_base"),
    (r"Error before and after, against the noise", "bars"),
    (r"torque error of each joint by family", "by_family"),
)
#: Labels made of others: their fields are put into words first.
_MADE_OF_OTHERS = _compiled(
    (r"(?P<view>[^:]+): (?P<label>[xyz] of base \[.+\])", "view"),
    (r"(?P<view>[^,]+), residual arrows, (?P<factor>\S+) times life size", "arrows"),
    (r"(?P<component>.+): measured and simulated torque", "traces"),
    (r"(?P<response>.+) against (?P<driver>.+)", "against"),
)


def in_language(label: str, language: str) -> str:
    """A label of a picture in a language; as it is where nothing is known of it."""
    if language == FALLBACK:
        return label
    for pattern, key in _LABELS:
        if match := pattern.fullmatch(label):
            return WORDS.text(f"plot.{key}", language, **match.groupdict())
    for pattern, key in _MADE_OF_OTHERS:
        if match := pattern.fullmatch(label):
            fields = {name: in_language(part, language) for name, part in match.groupdict().items()}
            return WORDS.text(f"plot.{key}", language, **fields)
    return label


def translated(picture: str, language: str) -> str:
    """An SVG with its labels, and the title read to those who cannot see it, in a language."""
    if language == FALLBACK:
        return picture
    return _SAID.sub(lambda m: m[1] + escape(in_language(unescape(m[2]), language), quote=True), picture)
