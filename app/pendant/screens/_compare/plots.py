"""The report's pictures inside a panel: the same drawing, its style confined to the picture."""

from __future__ import annotations

import re
from functools import cache
from html import escape, unescape

from app.diagnosis.report.curves import Curve
from app.diagnosis.report.drawing.bars import before_after_bars
from app.diagnosis.report.drawing.scatter import driver_plot
from app.diagnosis.report.drawing.traces import trace_plot
from app.diagnosis.report.parts.timeline import windows_of
from app.diagnosis.report.style import PICTURES
from app.diagnosis.result import Diagnosis, Evidence
from app.pendant.texts import FALLBACK, text

PANEL_WIDTH = 340.0
_TEXT = re.compile(r"(<(?:text|title)\b[^>]*>)([^<]*)(</)")
#: What the pictures are labelled with, whole labels -> the key of their translation.
_LABELS = tuple(
    (re.compile(pattern), key)
    for pattern, key in (
        (r"rows fitted", "fitted"),
        (r"rows held out", "held_out"),
        (r"joint (?P<n>\d+)", "joint"),
        (r"joint (?P<n>\d+): torque \[(?P<unit>.+)\]", "torque"),
        (r"torque error of joint (?P<n>\d+) \[(?P<unit>.+)\]", "torque_error"),
        (r"joint (?P<n>\d+) off by \[(?P<unit>.+)\]", "off"),
        (r"error along its main direction \[(?P<unit>.+)\]", "along"),
        (r"time \[(?P<unit>.+)\]", "time"),
        (r"temperature \[(?P<unit>.+)\]", "temperature"),
        (r"line of the file", "line"),
        (r"gravity torque of joint (?P<n>\d+) \[(?P<unit>.+)\]", "gravity_torque"),
        (r"angle of joint (?P<n>\d+) \[(?P<unit>.+)\]", "angle"),
        (r"position of joint (?P<n>\d+) \[(?P<unit>.+)\]", "position"),
        (r"last move of joint (?P<n>\d+)", "last_move"),
        (r"speed of joint (?P<n>\d+) \[(?P<unit>.+)\]", "speed"),
        (r"acceleration of joint (?P<n>\d+) \[(?P<unit>.+)\]", "acceleration"),
        (r"temperature of joint (?P<n>\d+) \[(?P<unit>.+)\]", "joint_temperature"),
    )
)


def bars(diagnosis: Diagnosis, language: str = FALLBACK) -> str:
    """Error before and after against the noise."""
    return _framed(before_after_bars(diagnosis, width=PANEL_WIDTH), "compare-bars", language)


def curve(of: Curve, language: str = FALLBACK) -> str:
    """Residual against one driver."""
    return _framed(driver_plot(of), "compare-curve", language)


def trace(
    evidence: Evidence,
    joint: int,
    diagnosis: Diagnosis | None,
    at: float | None,
    language: str = FALLBACK,
) -> str:
    """Torque of one joint (from 0) over time, the shown moment marked."""
    windows = windows_of(diagnosis) if diagnosis is not None else []
    drawn = trace_plot(evidence, joint, windows, labelled=True, width=PANEL_WIDTH, at=at)
    return _framed(drawn, "compare-trace", language)


def in_language(label: str, language: str) -> str:
    """A label of a picture in the operator's language; as it is where nothing is known of it."""
    if language == FALLBACK:
        return label
    for pattern, key in _LABELS:
        match = pattern.fullmatch(label)
        if match:
            return text(f"plot.{key}", language, **match.groupdict())
    return label


def _framed(picture: str, testid: str, language: str) -> str:
    """On white in light and dark pages alike: the colours were chosen for paper."""
    picture = _TEXT.sub(lambda m: m[1] + escape(in_language(unescape(m[2]), language)) + m[3], picture)
    return (
        f'<div class="tf-plot" data-testid="{testid}" style="--before:#d97b16;--after:#1866ad;--noise:#7b8794;'
        f'background:#fff;border-radius:4px;margin:4px 8px;padding:3px"><style>{_confined()}</style>{picture}</div>'
    )


@cache
def _confined() -> str:
    """Every rule of the pictures' style, for what is inside `.tf-plot` only."""
    rules = re.findall(r"([^{}]+)\{([^}]*)\}", PICTURES)
    return "".join(
        ",".join(f".tf-plot {one.strip()}" for one in selector.split(",")) + "{" + body + "}"
        for selector, body in rules
    )
