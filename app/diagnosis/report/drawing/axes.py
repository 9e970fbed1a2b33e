"""A box with scales: where a value lies on the paper, ticks that a person would choose."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from app.diagnosis.report.drawing import svg


@dataclass(frozen=True)
class Axes:
    """A rectangle on the paper and the range of values it shows.

    Args:
        left, top, width, height: the rectangle, in units of the picture.
        x_range, y_range: values at its edges.
    """

    left: float
    top: float
    width: float
    height: float
    x_range: tuple[float, float]
    y_range: tuple[float, float]

    def x(self, values):
        """Values to paper, left to right."""
        low, high = self.x_range
        return self.left + (np.asarray(values, float) - low) / (high - low) * self.width

    def y(self, values):
        """Values to paper, upwards."""
        low, high = self.y_range
        return self.top + self.height - (np.asarray(values, float) - low) / (high - low) * self.height

    def frame(self, x_label: str = "", y_label: str = "", *, x_ticks: int = 5, y_ticks: int = 4) -> str:
        """Grid, tick labels and names of the axes."""
        out = []
        bottom, right = self.top + self.height, self.left + self.width
        for value in ticks(*self.y_range, y_ticks):
            y = float(self.y(value))
            out.append(
                svg.tag("line", klass="zero" if value == 0 else "grid", x1=self.left, x2=right, y1=y, y2=y)
            )
            out.append(svg.text(self.left - 5, y + 3, tick_text(value), klass="tick end"))
        if x_ticks:
            for value in ticks(*self.x_range, x_ticks):
                x = float(self.x(value))
                out.append(svg.tag("line", klass="grid", x1=x, x2=x, y1=self.top, y2=bottom))
                out.append(svg.text(x, bottom + 12, tick_text(value), klass="tick mid"))
        if x_label:
            out.append(svg.text(self.left + self.width / 2, bottom + 26, x_label, klass="label mid"))
        if y_label:
            out.append(svg.text(self.left, self.top - 7, y_label, klass="label"))
        return "".join(out)


def ticks(low: float, high: float, about: int) -> list[float]:
    """Round values inside a range, `about` as many as asked."""
    if not (math.isfinite(low) and math.isfinite(high)) or high <= low:
        return []
    rough = (high - low) / max(about, 1)
    power = 10.0 ** math.floor(math.log10(rough))
    step = next((s * power for s in (1, 2, 2.5, 5, 10) if s * power >= rough * 0.999), 10 * power)
    first = math.ceil(low / step - 1e-9)
    return [k * step if k else 0.0 for k in range(first, math.floor(high / step + 1e-9) + 1)]


def tick_text(value: float) -> str:
    """A tick's number, as short as it can be, with a true minus sign."""
    if value != 0 and not 1e-4 <= abs(value) < 1e6:
        return f"{value:.1e}".replace("-", "−")
    return f"{value:.6g}".replace("-", "−")


def padded(values: np.ndarray, share: float = 0.06, *, zero: bool = False) -> tuple[float, float]:
    """The range of values with some air; `zero` makes it hold 0."""
    finite = np.asarray(values, float)
    finite = finite[np.isfinite(finite)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)
    if zero:
        low, high = min(low, 0.0), max(high, 0.0)
    air = (high - low) * share or abs(high) * share or 1.0
    return low - air, high + air
