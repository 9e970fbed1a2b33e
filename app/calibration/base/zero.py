"""Where joint 1 stood while axis 2 was turned.

The procedure starts both arcs from the zero position, so angle zero of both is one place. If axis 2 was turned
with joint 1 elsewhere, that place lies elsewhere on the circle of axis 1: its azimuth is joint 1's angle, and
X of the frame found points there instead of to the maker's X.
"""

from __future__ import annotations

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.result import BaseCalibration, ZeroPlace
from app.calibration.base.sense import wrapped
from app.units import from_deg, from_mm

_MARGIN = from_deg(20)  # how far beyond the recorded angles zero may lie
_CLOSE = from_mm(2.0)  # a reflector that was not touched comes back within this


def zero_place(base: BaseCalibration) -> ZeroPlace | None:
    """Joint 1's angle during the arc of axis 2, or None where the arcs carry no angles to tell it."""
    stated = base.source.axis2_at
    place = _place(base.second)
    first = base.first
    found = None
    if place is not None and first.sense.phase is not None and first.moved_at is None:
        fit, sign = first.fit, first.sense.sign
        local = fit.basis @ (place - fit.point)
        group = int(np.argmin(np.abs(local[2] - fit.heights) + np.abs(np.hypot(*local[:2]) - fit.radii)))
        miss = float(np.hypot(local[2] - fit.heights[group], np.hypot(*local[:2]) - fit.radii[group]))
        angle = float(wrapped(sign * (np.arctan2(local[1], local[0]) - first.sense.phase[group])))
        limit = max(_CLOSE, 5.0 * (first.sigma_centre + base.second.sigma_centre))
        # What keeps the circles from meeting may as well lie along the circle.
        sigma = float(np.hypot(miss, first.sigma) / max(fit.radii[group], 1e-6))
        found = ZeroPlace(angle, sigma, miss, miss < limit)
    if stated is not None:
        return ZeroPlace(stated, 0.0, found.miss if found else 0.0, True, stated=True)
    return found


def _place(second: ArcFit) -> np.ndarray | None:
    """(3,) [m] where angle zero of axis 2 lies on its (first) circle."""
    angles, phase = second.arc.angles, second.sense.phase
    if angles is None or phase is None or second.sense.sign == 0 or second.moved_at is not None:
        return None
    if not angles.min() - _MARGIN <= 0.0 <= angles.max() + _MARGIN:
        return None
    fit = second.fit
    outwards = np.cos(phase[0]) * fit.basis[0] + np.sin(phase[0]) * fit.basis[1]
    return fit.centres[0] + fit.radii[0] * outwards
