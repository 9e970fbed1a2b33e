"""Marginality: a higher level of laws keeps only what no lower level can take.

{zeros, geometry, elasticity} come before {waves, play, ratios, couplings}, those before what has no name.

Without it smooth curves share in what a law explains, and its value is too small.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.thresholds.evidence import RIDGE

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.library import Linear


def put_in_order(linear: Linear) -> None:
    """Applies marginality to a design, level by level from below."""
    at: dict[Level, set[int]] = {level: set() for level in Level}
    for number, columns in linear.columns.items():
        effect = linear.library.fixed[number].effect
        if effect.level == Level.UNKNOWN or effect.whole:
            at[effect.level].update(columns.tolist())
    lower: set[int] = set()
    at[Level.CALIBRATION] |= at.pop(Level.MECHANISM)
    for level in at:
        upper = at[level]
        if lower and upper:
            linear.design.leave_to(np.array(sorted(lower)), np.array(sorted(upper)), RIDGE)
        lower |= upper
