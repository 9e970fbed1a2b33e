"""The report's pictures inside a panel: the same drawing, its style confined to the picture."""

from __future__ import annotations

import re
from functools import cache

from app.diagnosis.report.budget import budget, budget_sentence, unexplained_sentence
from app.diagnosis.report.curves import Curve
from app.diagnosis.report.drawing.bars import before_after_bars
from app.diagnosis.report.drawing.budget_bar import budget_bar
from app.diagnosis.report.drawing.scatter import driver_plot
from app.diagnosis.report.drawing.traces import trace_plot
from app.diagnosis.report.events import events_of
from app.diagnosis.report.picture_words import translated
from app.diagnosis.report.style import PICTURES
from app.diagnosis.result import Diagnosis, Evidence
from app.diagnosis.wording import WORDS
from app.panel import markup as html
from app.phrases import FALLBACK
from app.texts import text

PANEL_WIDTH = 340.0


def share_of_families(diagnosis: Diagnosis, language: str = FALLBACK) -> str:
    """The error budget: the sentence, and the bar with its legend; "" where no families were measured."""
    drawn = budget_bar(budget(diagnosis), language, width=PANEL_WIDTH)
    if not drawn:
        return ""
    sentence = html.paragraph(budget_sentence(diagnosis, language), testid="compare-budget", strong=True)
    left = unexplained_sentence(diagnosis, language)
    return sentence + _framed(drawn, "compare-budget-bar", language) + (html.paragraph(left) if left else "")


def _legend(language: str, *, found: bool, measured: bool = False) -> str:
    """What the colours of a picture are."""
    keys = ("measured",) * measured + ("before",) + ("found",) * found
    return html.joined(
        html.safe('<div class="legend {}">{}</div>', look, WORDS.text(f"page.key.{look}", language))
        for look in keys
    )


def bars(diagnosis: Diagnosis, language: str = FALLBACK) -> str:
    """Error before and after against the noise."""
    drawn = _framed(before_after_bars(diagnosis, width=PANEL_WIDTH), "compare-bars", language)
    noise = html.paragraph(text("compare.dashed", language), faint=True) if 'class="noise"' in drawn else ""
    return _legend(language, found=True) + drawn + noise


def curve(of: Curve, language: str = FALLBACK, *, found: bool = True) -> str:
    """Residual against one driver; `found` where a search has been made."""
    return _legend(language, found=found) + _framed(driver_plot(of), "compare-curve", language)


def trace(
    evidence: Evidence,
    joint: int,
    diagnosis: Diagnosis | None,
    at: float | None,
    language: str = FALLBACK,
) -> str:
    """Torque of one joint (from 0) over time, the shown moment marked."""
    events = events_of(diagnosis) if diagnosis is not None else ()
    drawn = trace_plot(evidence, joint, events, labelled=True, width=PANEL_WIDTH, at=at)
    legend = _legend(language, found=diagnosis is not None, measured=True)
    areas = html.paragraph(text("compare.areas", language), faint=True) if evidence.parts else ""
    return legend + _framed(drawn, "compare-trace", language) + areas


def _framed(picture: str, testid: str, language: str) -> str:
    """The report's drawing in the page's colours (`panel.css`)."""
    return html.Markup(  # drawn by ours, every text in it escaped where it is drawn (report/drawing/svg.py)
        f'<div class="tf-plot" data-testid="{testid}">'
        f"<style>{_confined()}</style>{translated(picture, language)}</div>"
    )


@cache
def _confined() -> str:
    """Every rule of the pictures' style, for what is inside `.tf-plot` only."""
    rules = re.findall(r"([^{}]+)\{([^}]*)\}", PICTURES)
    return "".join(
        ",".join(f".tf-plot {one.strip()}" for one in selector.split(",")) + "{" + body + "}"
        for selector, body in rules
    )
