"""SVG elements as text."""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from html import escape

import numpy as np


def tag(name: str, content: str = "", **attributes: object) -> str:
    """One element; `stroke_width=2` becomes stroke-width="2", `klass` becomes class."""
    said = "".join(
        f' {"class" if k == "klass" else k.replace("_", "-")}="{escape(_value(v), quote=True)}"'
        for k, v in attributes.items()
        if v is not None
    )
    return f"<{name}{said}>{content}</{name}>" if content else f"<{name}{said}/>"


def text(x: float, y: float, words: str, **attributes: object) -> str:
    """Words at a point."""
    return tag("text", escape(words), x=x, y=y, **attributes)


def escaped(words: str) -> str:
    """Words as the content of an element."""
    return escape(words)


def picture(width: float, height: float, content: Iterable[str], title: str) -> str:
    """A whole picture that scales with the page; `title` is read to those who cannot see it."""
    inside = "".join(content)
    return (
        f'<svg viewBox="0 0 {_value(width)} {_value(height)}" role="img" aria-label="{escape(title, quote=True)}" '
        f'xmlns="http://www.w3.org/2000/svg">{inside}</svg>'
    )


def dots(x: np.ndarray, y: np.ndarray, klass: str) -> str:
    """Many points as one path: a stroke of no length with a round end is a dot."""
    if not len(x):
        return ""
    path = "".join(f"M{a:.1f} {b:.1f}h0" for a, b in zip(x, y, strict=True))
    return f'<path class="{klass}" d="{path}"/>'


def line(x: np.ndarray, y: np.ndarray, klass: str) -> str:
    """A broken line; NaN lifts the pen."""
    path, down = [], False
    for a, b in zip(x, y, strict=True):
        if not (np.isfinite(a) and np.isfinite(b)):
            down = False
            continue
        path.append(f"{'L' if down else 'M'}{a:.1f} {b:.1f}")
        down = True
    return f'<path class="{klass}" d="{"".join(path)}"/>' if path else ""


def segments(x0: np.ndarray, y0: np.ndarray, x1: np.ndarray, y1: np.ndarray, klass: str) -> str:
    """Many separate strokes as one path."""
    path = "".join(f"M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" for a, b, c, d in zip(x0, y0, x1, y1, strict=True))
    return f'<path class="{klass}" d="{path}"/>' if path else ""


def area(x: np.ndarray, low: np.ndarray, high: np.ndarray, fill: str) -> str:
    """What lies between two lines, as one path; nothing where they are the same throughout."""
    if not np.any(np.abs(high - low) > 0.05):
        return ""
    there = " ".join(f"{a:.1f} {b:.1f}" for a, b in zip(x, high, strict=True))
    back = " ".join(f"{a:.1f} {b:.1f}" for a, b in zip(x[::-1], low[::-1], strict=True))
    return tag("path", d=f"M{there} L{back}Z", fill=fill)


def clipped(left: float, top: float, width: float, height: float, content: Iterable[str]) -> tuple[str, str]:
    """A clipping rectangle and the content inside it; its name comes from both, so that pages repeat exactly."""
    inside = "".join(content)
    name = f"clip{zlib.crc32(f'{left} {top} {width} {height} {inside}'.encode())}"
    box = tag("rect", x=left, y=top, width=width, height=height)
    return tag("clipPath", box, id=name), tag("g", inside, clip_path=f"url(#{name})")


def _value(value: object) -> str:
    if isinstance(value, float | np.floating):
        return f"{float(value):.2f}".rstrip("0").rstrip(".")
    return str(value)
