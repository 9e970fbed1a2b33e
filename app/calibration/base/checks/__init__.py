"""One file a thing that can go wrong with arcs. Each has a `CHECK` with its code; found by listing.

A check looks at one or more stages; it yields warnings, or raises where the result would be wrong:

    points     one recorded Arc, before anything is fitted
    arc        one ArcFit
    parallel   the sine of the angle between axis 1 and axis 2
    frame      the BaseCalibration
    pair       the Relation of two robots
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from app import catalog
from app.calibration.result import Warning_


@dataclass(frozen=True)
class Check:
    """One thing that can go wrong.

    Args:
        key: the code in warnings and errors.
        title: what it guards against.
        stages: stage -> what looks there.
    """

    key: str
    title: str
    stages: Mapping[str, Callable[[Any], Iterable[Warning_]]] = field(default_factory=dict)


def look(stage: str, subject: Any) -> list[Warning_]:
    """Everything the checks of one stage have to say.

    Raises:
        DegenerateGeometryError: a check refuses.
    """
    found: list[Warning_] = []
    for check in catalog.members(__name__, "CHECK").values():
        if stage in check.stages:
            found += check.stages[stage](subject)
    return found
