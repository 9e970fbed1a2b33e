"""Residuals that deny the noise that was stated."""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.result import Warning_
from app.units import mm


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if found.stated and found.scale > 1.0:
        yield Warning_(
            CHECK.key,
            f"axis {found.arc.axis}: the points lie {found.scale**0.5:.1f} times as far from their circle as the "
            f"stated noise allows ({mm(found.rms):.3f} mm rms); the uncertainties were widened by that",
            "another axis may have moved along, or the beam passed near something warm",
        )


CHECK = Check("noise", "more noise than stated", {"arc": _arc})
