"""The gap to a tool that was stated elsewhere (printed, or measured with a gauge), and what explains it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from app.calibration.quality.rounding import Rounding
from app.calibration.result import ToolCalibration
from app.calibration.wording import TEXTS, phrase
from app.estimation import HALF
from app.units import mm

#: A gap this rare under an explanation is not explained by it.
RARE = 0.05


@dataclass(frozen=True, eq=False)
class Gap:
    """Result minus a stated tool point.

    Args:
        name: what the file calls the stated one.
        gap: (3,) [m].
        sigmas: (3,) the same in standard deviations of rounding; inf where rounding cannot move that axis.
        explained_by: "rounding", "touch noise" or "nothing".
        p_value: how often the explanation produces a gap at least as large.
    """

    name: str
    gap: np.ndarray
    sigmas: np.ndarray
    explained_by: str
    p_value: float

    def title(self, language: str = "en") -> str:
        """What the tool beside it is called: `measured tool`."""
        known = f"stated.{self.name}"
        return TEXTS.text(known, language) if TEXTS.has(known) else self.name.replace("_", " ")

    def sentence(self, language: str = "en") -> str:
        """What a person reads."""
        text = ", ".join(f"{a} {v:+.3f}" for a, v in zip("xyz", mm(self.gap), strict=True))
        key = {"rounding": "rounding", "touch noise": "noise"}.get(self.explained_by, "nothing")
        most = float(np.max(np.abs(self.sigmas))) / HALF
        name = self.title(language)
        return phrase(f"gap.{key}", name=name, gap=text, most=most, p=self.p_value).text(language)


def gap_to(name: str, stated: np.ndarray, result: ToolCalibration, effect: Rounding) -> Gap:
    """Weighs the gap first against rounding, then against the noise of the touches."""
    gap = result.tool_point - stated
    sigma = effect.sigma_tool
    with np.errstate(divide="ignore", invalid="ignore"):
        sigmas = np.where(gap == 0.0, 0.0, gap / sigma)
    p = 0.0
    if (sigma > 0).all():
        p = float(special.chdtrc(3, gap @ np.linalg.solve(effect.covariance, gap)))
    if p > RARE:
        return Gap(name, gap, sigmas, "rounding", p)
    if result.dof > 0 and result.sigma > 0:
        noise = float(special.fdtrc(3, result.dof, gap @ np.linalg.solve(result.covariance, gap) / 3.0))
        return Gap(name, gap, sigmas, "touch noise" if noise > RARE else "nothing", noise)
    return Gap(name, gap, sigmas, "nothing", p)
