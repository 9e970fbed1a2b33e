"""Small pictures of the scorecard, drawn as SVG."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.proof.intervals import Rate

WIDE, HIGH = 220, 16


def interval_bar(rate: Rate, aim: float | None) -> str:
    """A rate as a dot on its interval, from 0 to 1; the aim as a tick."""
    low, high = rate.interval
    value = rate.value or 0.0
    tick = (
        f'<line x1="{aim * WIDE:.1f}" x2="{aim * WIDE:.1f}" y1="1" y2="15" stroke="#1d7f4e" stroke-width="2"/>'
        if aim is not None
        else ""
    )
    return (
        f'<svg width="{WIDE}" height="{HIGH}" role="img" aria-label="{low:.3f} to {high:.3f}">'
        f'<line x1="0" x2="{WIDE}" y1="8" y2="8" stroke="#d8dde4"/>'
        f'<line x1="{low * WIDE:.1f}" x2="{high * WIDE:.1f}" y1="8" y2="8" stroke="#2a62b8" stroke-width="4"/>'
        f'{tick}<circle cx="{value * WIDE:.1f}" cy="8" r="4.5" fill="#2a62b8"/></svg>'
    )


def histogram(values: Sequence[float], *, low: float, high: float, floor: float) -> str:
    """How often which ratio came; a line stands at the floor. Values beyond the ends are in the last bars."""
    width, height, bins = 720, 170, 36
    counts, _ = np.histogram(np.clip(values, low, high - 1e-9), bins=bins, range=(low, high))
    step = width / bins
    top = max(int(counts.max()), 1)
    bars = "".join(
        f'<rect x="{i * step:.1f}" y="{height - 24 - c / top * (height - 40):.1f}" width="{step - 2:.1f}" '
        f'height="{c / top * (height - 40):.1f}" fill="#7ea3da"/>'
        for i, c in enumerate(counts)
    )
    place = (floor - low) / (high - low) * width
    marks = "".join(
        f'<text x="{(v - low) / (high - low) * width:.0f}" y="{height - 6}" font-size="11" text-anchor="middle" '
        f'fill="#5c6674">{v:.1f}</text>'
        for v in np.arange(low + 0.1, high, 0.1)
    )
    line = f'<line x1="{place:.1f}" x2="{place:.1f}" y1="0" y2="{height - 24}" stroke="#1d7f4e" stroke-width="2"/>'
    frame = f'<svg viewBox="0 0 {width} {height}" width="100%" role="img" aria-label="histogram">'
    return f"{frame}{bars}{line}{marks}</svg>"
