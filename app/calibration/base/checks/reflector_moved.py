"""The reflector shifted in its nest, or the nest on the flange, in the middle of an arc."""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.result import Warning_
from app.units import mm


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if found.moved_at is None:
        return
    yield Warning_(
        CHECK.key,
        f"axis {found.arc.axis}: from row {found.moved_at} on the reflector sits {mm(found.moved_by):.3f} mm "
        f"elsewhere; both parts were fitted as circles of their own about one axis",
        "seat the reflector firmly and record this axis again",
        severe=True,
    )


CHECK = Check("reflector_moved", "the reflector moved during the arc", {"arc": _arc})
