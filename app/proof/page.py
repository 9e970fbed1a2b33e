"""The scorecard as one page that stands alone and prints; its template escapes every text (Jinja2, autoescape)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from markupsafe import Markup

from app.proof.controls import TITLES
from app.proof.intervals import Rate
from app.proof.pictures import histogram, interval_bar
from app.proof.run import Proof, failed, failure
from app.proof.scoring import heldout_summary
from app.proof.table import aim_text, transfer_text
from app.templating import templates

#: What is shown of a case that failed.
_KEYS = ("case", "stratum", "recording", "true", "verdict", "said", "leftover", "misses")
_SHADE = "42, 98, 184"  # of the confusion's cells: red, green, blue


def page(proof: Proof) -> str:
    """HTML without a reference to anything outside itself."""
    columns, confusion = _confusion(proof.score.confusion)
    ratios = [value for _, value in proof.score.heldout]
    wholes = [case.whole for case in proof.judged]
    carried = [w.transfer for w in wholes if w and not w.unknown and w.transfer is not None]
    return (
        templates(__file__)
        .get_template("scorecard.html")
        .render(
            proof=proof,
            columns=columns,
            confusion=confusion,
            held=heldout_summary(ratios),
            held_picture=_drawn(histogram(ratios, low=0.7, high=1.6, floor=1.0)) if ratios else "",
            transfer=[transfer_text(over, told) for over, told in proof.score.transfer.items()],
            transfer_picture=_drawn(histogram(carried, low=0.5, high=2.5, floor=1.0)) if carried else "",
            titles=TITLES,
            keys=_KEYS,
            failures=[[_said(failure(case)[key]) for key in _KEYS] for case in proof.judged if failed(case)],
            versions=", ".join(f"{name} {version}" for name, version in proof.versions.items()),
            interval_bar=_bar,
            aim_text=aim_text,
        )
    )


def _confusion(
    confusion: Mapping[str, Mapping[str, int]],
) -> tuple[Sequence[str], list[dict[str, Any]]]:
    """What was said, and a row for what was true, with the look of each cell."""
    columns = sorted(
        {said for row in confusion.values() for said in row}, key=lambda s: (s.startswith("("), s)
    )
    rows = []
    for true, said in confusion.items():
        total = sum(said.values())
        cells = [
            {"count": (n := said.get(column, 0)), "style": _style(n / total, column == _right(true))}
            for column in columns
        ]
        rows.append({"true": true, "total": total, "cells": cells})
    return columns, rows


def _style(share: float, right: bool) -> str:
    """How a cell looks with so much of its row in it."""
    shade = f"background: rgba({_SHADE}, {0.08 + 0.92 * share:.2f})" if share else "background: #f6f7f9"
    ink = "; color: #fff" if share > 0.5 else ""
    return shade + ink + ("; outline: 2px solid #1d7f4e; outline-offset: -2px" if right else "")


def _right(true: str) -> str:
    """What should have been said of a row."""
    if true in ("(nothing)", "(too faint)"):
        return "(clean)"
    return "(unexplained)" if true.startswith("(") else true


def _said(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{k}={v}" for k, v in value.items())
    if isinstance(value, list):
        return "; ".join(value)
    return str(value)


def _bar(rate: Rate, aim: float | None) -> Markup:
    return _drawn(interval_bar(rate, aim))


def _drawn(picture: str) -> Markup:
    """A picture made of numbers alone."""
    return Markup(picture)
