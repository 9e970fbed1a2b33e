"""Green, yellow, red: with the reason and the next action in words.

The makers' figure (mean distance) cannot see geometry, so the light looks at the predicted region too and takes the
worse of the two.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from app.calibration.quality.region import ellipsoid
from app.calibration.result import ToolCalibration
from app.units import from_mm, mm

Colour = Literal["green", "yellow", "red"]


@dataclass(frozen=True)
class Limits:
    """From where yellow and red begin [m]: the mean distance, and half the longest axis of the 95% region."""

    mean_yellow: float = from_mm(0.5)
    mean_red: float = from_mm(1.0)
    region_yellow: float = from_mm(1.5)
    region_red: float = from_mm(4.0)


@dataclass(frozen=True)
class Light:
    """A colour with its reason and what to do next."""

    colour: Colour
    reason: str
    action: str

    def __str__(self) -> str:
        return f"{self.colour.upper()}: {self.reason}. {self.action}."


def light(result: ToolCalibration, limits: Limits | None = None) -> Light:
    """The light of one result; the first reason that applies, worst first."""
    limits = limits or Limits()
    severe = [w for w in result.warnings if w.severe]
    if severe:
        return Light("red", severe[0].message, _sentence(severe[0].advice or "Teach again"))
    longest = float(ellipsoid(result).semi_axes[0]) if len(result.residual_vectors) else 0.0
    mean = f"the tips lie {mm(result.mean):.2f} mm from one point on average"
    region = f"the tool point is only known to {mm(longest):.2f} mm (95%)"
    if result.mean > limits.mean_red:
        return Light("red", mean, f"Record touch {result.worst + 1} again")
    if longest > limits.region_red:
        return Light("red", region, "Add touches that are tilted further, 45 degrees and more")
    if result.mean > limits.mean_yellow:
        return Light("yellow", mean, f"Record touch {result.worst + 1} again, or add a touch")
    if longest > limits.region_yellow:
        return Light("yellow", region, "Add a touch with the tool tilted another way")
    if result.warnings:
        first = result.warnings[0]
        return Light(
            "yellow", first.message, _sentence(first.advice or "Look at the warning before accepting")
        )
    if not len(result.residual_vectors):
        return Light(
            "yellow", "nothing was measured that could be checked", "Verify by turning about the tool point"
        )
    return Light(
        "green", f"{mean} and the tool point is known to {mm(longest):.2f} mm (95%)", "Accept, then verify"
    )


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]
