"""The reflector shifted in its nest, or the nest on the flange, in the middle of an arc."""

from __future__ import annotations

from collections.abc import Iterator

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.checks import Check
from app.calibration.base.wording import remark
from app.calibration.result import Warning_
from app.units import mm


def _arc(found: ArcFit) -> Iterator[Warning_]:
    if found.moved_at is None:
        return
    yield remark(CHECK.key, severe=True, axis=found.arc.axis, row=found.moved_at, shift=mm(found.moved_by))


CHECK = Check("reflector_moved", "the reflector moved during the arc", {"arc": _arc})
