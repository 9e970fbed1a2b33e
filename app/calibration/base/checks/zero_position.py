"""The arcs do not start from one zero position."""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.checks import Check
from app.calibration.base.result import BaseCalibration
from app.calibration.result import Warning_
from app.units import deg, from_deg, mm

_ZERO = from_deg(0.05)  # a pendant shows hundredths


def _frame(base: BaseCalibration) -> Iterator[Warning_]:
    zero = base.zero
    if zero is None or not zero.known or abs(zero.angle) <= max(_ZERO, 5.0 * zero.sigma):
        return
    how = "stated" if zero.stated else f"found where the circles meet, within {mm(zero.miss):.2f} mm"
    yield Warning_(
        CHECK.key,
        f"axis 2 was turned with joint 1 at {deg(zero.angle):.2f} degrees ({how}), not at zero: X of T_tracker_base "
        f"points there; the maker's frame has it taken out",
        "turn axis 2 from the zero position",
    )


CHECK = Check("zero_position", "axis 2 not turned from zero", {"frame": _frame})
