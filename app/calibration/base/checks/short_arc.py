"""An arc under 90 degrees, with the error it costs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.estimation import HALF
from app.geometry.circle import fit_axis
from app.units import deg, from_deg, mm

SHORT = from_deg(90)
_SLACK = from_deg(0.05)  # 90 degrees by the pendant may come out a little less
_GOOD = from_deg(180)


def expected(points: int, radius: float, sigma: float, arc: float) -> tuple[float, float]:
    """One-sigma error of the axis [rad] and of the centre [m] for evenly spread points on an arc [rad]."""
    t = np.linspace(0.0, arc, points)
    perfect = radius * np.stack([np.cos(t), np.sin(t), np.zeros_like(t)], axis=1)
    c = fit_axis(perfect).covariance
    return sigma * float(np.sqrt(c[2, 2] + c[3, 3])), sigma * float(np.sqrt(c[0, 0] + c[1, 1]))


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if found.length >= SHORT - _SLACK:
        return
    axis, centre = expected(max(int(found.used.sum()), 4), found.radius, found.sigma, _GOOD)
    yield remark(
        CHECK.key,
        axis=found.arc.axis,
        arc=deg(found.length),
        tilt=HALF * deg(found.sigma_axis),
        centre=HALF * mm(found.sigma_centre),
        good_tilt=HALF * deg(axis),
        good_centre=HALF * mm(centre),
    )


CHECK = Check("short_arc", "an arc under 90 degrees", {"arc": _arc})
