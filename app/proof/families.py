"""What differs between proving the static and the motion diagnosis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app import catalog
from app.proof import controls, controls_motion, drawing, drawing_motion, drawing_whole, drawing_whole_motion
from app.proof.generator.motion.cell import OUTSIDE as OUTSIDE_MOTION
from app.proof.generator.static.cell import OUTSIDE


@dataclass(frozen=True)
class Family:
    """One family of recordings.

    Args:
        strata: package of its strata; whole: packages of those of arms that are off everywhere.
        outside: package of the laws no library holds.
        draw: makes one case; draw_whole: of an arm that is off everywhere.
        draw_control: makes one negative control; `controls` are their kinds and titles.
    """

    key: str
    strata: str
    whole: tuple[str, ...]
    outside: str
    draw: Callable[[int, int, str, Path], dict[str, Any]]
    draw_whole: Callable[[int, int, str, Path], dict[str, Any]]
    draw_control: Callable[[int, int, str, Path], controls.Control]
    controls: dict[str, str]

    def strange(self) -> frozenset[str]:
        """Effects that no library holds."""
        return frozenset(catalog.members(self.outside, "EFFECT"))


FAMILIES = {
    "static": Family(
        "static",
        drawing.STRATA,
        (drawing_whole.STRATA,),
        OUTSIDE,
        drawing.draw_static,
        drawing_whole.draw_whole_static,
        controls.draw_control,
        controls.TITLES,
    ),
    "motion": Family(
        "motion",
        drawing_motion.STRATA,
        (drawing_whole_motion.STRATA,),
        OUTSIDE_MOTION,
        drawing_motion.draw_motion,
        drawing_whole_motion.draw_whole_motion,
        controls_motion.draw_control,
        controls.TITLES,
    ),
}
