"""Green, yellow, red: with the reason and the next action in words.

The makers' figure (mean distance) cannot see geometry, so the light looks at the predicted region too and takes the
worse of the two.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from app.calibration.quality.region import ellipsoid
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import FALLBACK, Phrase, phrase
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
    """A colour with its reason and what to do next, not in words yet."""

    colour: Colour
    why: Phrase
    todo: Phrase

    @property
    def reason(self) -> str:
        """Why, in English."""
        return self.why.text()

    @property
    def action(self) -> str:
        """What to do next, in English."""
        return _sentence(self.todo.text())

    def __str__(self) -> str:
        return self.said()

    def said(self, language: str = FALLBACK) -> str:
        """Colour, reason and what to do next."""
        colour, action = phrase(f"light.{self.colour}"), _sentence(self.todo.text(language))
        return phrase("light.said", colour=colour, reason=self.why, action=action).text(language)

    def sentence(self, language: str = FALLBACK, todo: str = "") -> str:
        """Reason and what to do next, for a place that shows the colour itself.

        Args:
            todo: what is next in the meantime, without a full stop; empty for what the result asks for.
        """
        reason, action = _sentence(self.why.text(language)), todo or _sentence(self.todo.text(language))
        return phrase("light.sentence", reason=reason, action=action).text(language)


def light(result: ToolCalibration, limits: Limits | None = None) -> Light:
    """The light of one result; the first reason that applies, worst first."""
    limits = limits or Limits()
    severe = [w for w in result.warnings if w.severe]
    if severe:
        return _warned("red", severe[0], "light.teach")
    longest = float(ellipsoid(result).semi_axes[0]) if len(result.residual_vectors) else 0.0
    figures = {"mean": mm(result.mean), "region": mm(longest), "touch": result.worst + 1}

    def shown(colour: Colour, why: str, todo: str) -> Light:
        return Light(colour, phrase(f"light.{why}", **figures), phrase(f"light.{todo}", **figures))

    if result.mean > limits.mean_red:
        return shown("red", "mean", "again")
    if longest > limits.region_red:
        return shown("red", "region", "tilt_further")
    if result.mean > limits.mean_yellow:
        return shown("yellow", "mean", "again_or_add")
    if longest > limits.region_yellow:
        return shown("yellow", "region", "add")
    if look := [w for w in result.warnings if not w.note]:
        return _warned("yellow", look[0], "light.look")
    if not len(result.residual_vectors):
        return shown("yellow", "unmeasured", "verify")
    return shown("green", "good", "accept")


def _warned(colour: Colour, warning: Warning_, fallback: str) -> Light:
    if warning.phrases:
        return Light(colour, *warning.phrases)
    todo = phrase("light.plain", text=warning.advice) if warning.advice else phrase(fallback)
    return Light(colour, phrase("light.plain", text=warning.message), todo)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]
